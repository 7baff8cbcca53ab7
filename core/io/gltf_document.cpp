#include "core/io/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/io/input_error.h"
#include "core/io/mesh_formats.h"

namespace etalon::io {
namespace {

// Component types (glTF 2.0, 3.6.2.2).
enum : std::uint64_t { kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126 };

std::size_t component_bytes(std::uint64_t type) {
  switch (type) {
    case kByte:
    case kUnsignedByte: return 1;
    case kShort:
    case kUnsignedShort: return 2;
    case kUnsignedInt:
    case kFloat: return 4;
    default: return 0;
  }
}

int component_count(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4") return 4;
  return 0;
}

template <class T>
T load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);  // glTF is little-endian, as are the machines that we run on
  return value;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

}  // namespace

float GltfAccessor::real(std::size_t i, int c) const {
  const std::byte* at = bytes.data() + i * stride_bytes + static_cast<std::size_t>(c) * component_bytes(component_type);
  // glTF 2.0, 3.6.2.2: f = c / max; signed ones stop at -1.
  switch (component_type) {
    case kFloat: return load<float>(at);
    case kUnsignedByte:
      return normalized ? static_cast<float>(load<std::uint8_t>(at)) / 255.0f : static_cast<float>(load<std::uint8_t>(at));
    case kUnsignedShort:
      return normalized ? static_cast<float>(load<std::uint16_t>(at)) / 65535.0f : static_cast<float>(load<std::uint16_t>(at));
    case kByte:
      return normalized ? std::max(static_cast<float>(load<std::int8_t>(at)) / 127.0f, -1.0f) : static_cast<float>(load<std::int8_t>(at));
    case kShort:
      return normalized ? std::max(static_cast<float>(load<std::int16_t>(at)) / 32767.0f, -1.0f)
                        : static_cast<float>(load<std::int16_t>(at));
    default: return static_cast<float>(load<std::uint32_t>(at));
  }
}

std::uint32_t GltfAccessor::index(std::size_t i) const {
  const std::byte* at = bytes.data() + i * stride_bytes;
  if (component_type == kUnsignedByte) return load<std::uint8_t>(at);
  if (component_type == kUnsignedShort) return load<std::uint16_t>(at);
  return load<std::uint32_t>(at);
}

GltfDocument::GltfDocument(const std::filesystem::path& path, const FileBytes& content)
    : file_(path.string()), folder_(path.parent_path()) {
  const std::string_view text = split_container(content.bytes());
  const auto text_offset = static_cast<std::size_t>(text.data() - content.text().data());
  try {
    json_ = nlohmann::json::parse(text.begin(), text.end());
  } catch (const nlohmann::json::parse_error& error) {
    fail_at_byte(file_, text_offset + error.byte, "expected valid JSON: " + first_line(error.what()));
  } catch (const nlohmann::json::exception& error) {
    fail_at_byte(file_, text_offset, "expected valid JSON: " + first_line(error.what()));
  }
  const std::string version = root().at("asset").at("version").text();
  if (!version.starts_with("2.")) fail_file(file_, fmt::format("asset.version: expected 2.x, got '{}'", printable(version)));
  if (root().has("buffers")) buffers_.resize(root().at("buffers").size());
}

std::string_view GltfDocument::split_container(std::span<const std::byte> content) {
  const std::string_view all(reinterpret_cast<const char*>(content.data()), content.size());
  if (!all.starts_with("glTF")) {
    const std::size_t first = all.find_first_not_of(" \t\r\n");
    if (first == all.npos || (all[first] != '{' && all[first] != '\xEF'))
      fail_at_byte(file_, 0, fmt::format("expected glTF: the magic word 'glTF' or a JSON object, got '{}'", printable(all.substr(0, 8))));
    return all;
  }
  const auto u32 = [&](std::size_t at, const char* what) {
    if (content.size() < 4 || at > content.size() - 4) fail_at_byte(file_, at, fmt::format("the file ends early: expected {}", what));
    return load<std::uint32_t>(content.data() + at);
  };
  if (const std::uint32_t version = u32(4, "the container version"); version != 2)
    fail_at_byte(file_, 4, fmt::format("container version: expected 2, got {}", version));
  const std::size_t end = u32(8, "the container length");
  if (end > content.size()) fail_at_byte(file_, 8, fmt::format("the file ends early: expected {} bytes, got {}", end, content.size()));
  std::string_view json_text;
  std::size_t at = 12;
  for (int chunk = 0; chunk == 0 || at < end; ++chunk) {
    const std::size_t length = u32(at, "a chunk length");
    const std::uint32_t type = u32(at + 4, "a chunk type");
    at += 8;
    if (at > end || length > end - at)
      fail_at_byte(file_, at - 8, fmt::format("chunk length: expected at most {}, got {}", end - std::min(at, end), length));
    if (chunk == 0 && type != 0x4E4F534A) fail_at_byte(file_, at - 4, fmt::format("first chunk: expected type JSON, got {:08x}", type));
    if (chunk == 0) json_text = all.substr(at, length);
    if (chunk == 1 && type == 0x004E4942) binary_chunk_ = content.subspan(at, length);
    at += length;
  }
  return json_text;
}

std::span<const std::byte> GltfDocument::buffer(std::uint64_t index) {
  const JsonRef ref = root().at("buffers").at(index);
  Buffer& buffer = buffers_[static_cast<std::size_t>(index)];
  const std::uint64_t length = ref.at("byteLength").integer();
  if (!buffer.loaded) {
    if (!ref.has("uri")) {
      if (index != 0 || !binary_chunk_) ref.fail("expected a 'uri' or the binary chunk of a .glb, got neither");
      buffer.bytes = *binary_chunk_;
    } else {
      const std::string uri = ref.at("uri").text();
      if (std::optional<FileBytes> inline_bytes = decode_data_uri(ref.at("uri"), uri)) {
        buffer.own = std::move(*inline_bytes);
      } else {
        const std::filesystem::path beside = find_beside(folder_, percent_decoded(uri));
        if (beside.empty()) ref.fail(fmt::format("expected a file '{}', got none", printable(uri, 100)));
        buffer.own = read_file(beside);
        buffer_files_.push_back(beside);
      }
      buffer.bytes = buffer.own.bytes();
    }
    buffer.loaded = true;
  }
  if (length > buffer.bytes.size()) ref.fail(fmt::format("byteLength: expected at most {}, got {}", buffer.bytes.size(), length));
  return buffer.bytes.first(static_cast<std::size_t>(length));
}

std::span<const std::byte> GltfDocument::buffer_view(std::uint64_t index) {
  const JsonRef ref = root().at("bufferViews").at(index);
  const std::span<const std::byte> whole = buffer(ref.at("buffer").integer());
  const std::uint64_t offset = ref.integer_or("byteOffset", 0);
  const std::uint64_t length = ref.at("byteLength").integer();
  if (offset > whole.size() || length > whole.size() - offset)
    ref.fail(fmt::format("expected to lie within the buffer's {} bytes, got offset {} and length {}", whole.size(), offset, length));
  return whole.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

GltfAccessor GltfDocument::accessor(std::uint64_t index) {
  const JsonRef ref = root().at("accessors").at(index);
  if (ref.has("sparse")) ref.fail("sparse accessors are not supported");
  GltfAccessor result;
  result.path = ref.path();
  result.component_type = ref.at("componentType").integer();
  result.component_count = component_count(ref.at("type").text());
  result.normalized = ref.true_at("normalized");
  const std::uint64_t count = ref.at("count").integer();
  const std::size_t size = component_bytes(result.component_type) * static_cast<std::size_t>(result.component_count);
  if (size == 0) ref.fail("expected a scalar or vector of a glTF component type");
  const std::uint64_t view_index = ref.at("bufferView").integer();
  const std::span<const std::byte> view = buffer_view(view_index);
  const std::uint64_t stride = root().at("bufferViews").at(view_index).integer_or("byteStride", size);
  if (stride < size || stride > 252) ref.fail(fmt::format("byteStride: expected {} to 252, got {}", size, stride));
  const std::uint64_t offset = ref.integer_or("byteOffset", 0);
  // offset + (count − 1)·stride + size ≤ view.size(), written without overflow.
  if (count != 0 && (view.size() < size || offset > view.size() - size || count - 1 > (view.size() - size - offset) / stride))
    ref.fail(fmt::format("expected to lie within the view's {} bytes, got {} elements at offset {}", view.size(), count, offset));
  result.count = static_cast<std::size_t>(count);
  result.stride_bytes = static_cast<std::size_t>(stride);
  if (count != 0) result.bytes = view.subspan(static_cast<std::size_t>(offset));
  return result;
}

std::optional<FileBytes> decode_data_uri(const JsonRef& at, const std::string& uri) {
  if (!uri.starts_with("data:")) return std::nullopt;
  const std::size_t comma = uri.find(',');
  if (comma == uri.npos || uri.substr(0, comma).find(";base64") == uri.npos) at.fail("data URI: expected ';base64,'");
  std::string_view digits = std::string_view(uri).substr(comma + 1);
  while (!digits.empty() && digits.back() == '=') digits.remove_suffix(1);
  FileBytes result(digits.size() * 6 / 8);
  std::uint32_t bits = 0;
  int bit_count = 0;
  std::size_t out = 0;
  for (const char c : digits) {
    const int digit = base64_digit(c);
    if (digit < 0) at.fail(fmt::format("data URI: expected a base64 digit, got '{}'", printable(std::string_view(&c, 1))));
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    bit_count += 6;
    if (bit_count < 8) continue;
    bit_count -= 8;
    result.bytes()[out++] = static_cast<std::byte>(bits >> bit_count & 0xFF);
  }
  return result;
}

std::string percent_decoded(const std::string& uri) {
  std::string result;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(uri[i + 2]) : -1;
    if (low < 0) {
      result += uri[i];
      continue;
    }
    result += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return result;
}

}  // namespace etalon::io
