#include "core/io/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/io/atomic_file.h"
#include "core/io/exr_file.h"
#include "core/io/image_structure.h"
#include "core/io/input_error.h"
#include "core/io/inputs.h"

namespace etalon::io {
namespace {

namespace fs = std::filesystem;

enum class ImageFormat { png, jpeg, tiff, exr };

ImageFormat format_of(std::span<const std::byte> bytes, const std::string& name) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  using namespace std::literals;
  if (text.starts_with("\x89PNG\r\n\x1a\n"sv)) return ImageFormat::png;
  if (text.starts_with("\xff\xd8\xff"sv)) return ImageFormat::jpeg;
  if (text.starts_with("II*\0"sv) || text.starts_with("MM\0*"sv) || text.starts_with("II+\0"sv) || text.starts_with("MM\0+"sv))
    return ImageFormat::tiff;
  if (text.starts_with("\x76\x2f\x31\x01"sv)) return ImageFormat::exr;
  fail_file(name, fmt::format("image format: expected PNG, JPEG, TIFF or OpenEXR, got a file that begins with '{}'",
                              printable(text.substr(0, 8))));
}

ChannelType channel_type(const OIIO::TypeDesc& type, const std::string& name) {
  switch (type.basetype) {
    case OIIO::TypeDesc::UINT8: return ChannelType::unorm8;
    case OIIO::TypeDesc::UINT16: return ChannelType::unorm16;
    case OIIO::TypeDesc::HALF: return ChannelType::half;
    case OIIO::TypeDesc::INT16:
    case OIIO::TypeDesc::FLOAT:
    case OIIO::TypeDesc::DOUBLE: return ChannelType::float32;
    case OIIO::TypeDesc::UINT32: return ChannelType::uint32;
    default: fail_file(name, fmt::format("channel type: expected 8 bit unsigned, 16 bit, half, float or uint32, got {}", type.c_str()));
  }
}

OIIO::TypeDesc oiio_type(ChannelType type) {
  switch (type) {
    case ChannelType::unorm8:
    case ChannelType::srgb8: return OIIO::TypeDesc::UINT8;
    case ChannelType::unorm16: return OIIO::TypeDesc::UINT16;
    case ChannelType::half: return OIIO::TypeDesc::HALF;
    case ChannelType::float32: return OIIO::TypeDesc::FLOAT;
    case ChannelType::uint32: return OIIO::TypeDesc::UINT32;
  }
  return OIIO::TypeDesc::UNKNOWN;
}

/// Grey with alpha as RGBA: our two-channel format means RG.
Image grey_alpha_expanded(const Image& grey_alpha) {
  Image result(grey_alpha.width(), grey_alpha.height(), {grey_alpha.format().type, 4});
  const auto size = static_cast<std::size_t>(bytes_per_channel(grey_alpha.format().type));
  const std::byte* in = grey_alpha.bytes().data();
  std::byte* out = result.bytes().data();
  for (std::size_t i = 0; i < result.texel_count(); ++i, in += 2 * size, out += 4 * size) {
    for (std::size_t c = 0; c < 3; ++c) std::memcpy(out + c * size, in, size);
    std::memcpy(out + 3 * size, in + size, size);
  }
  return result;
}

Image decode_by_oiio(std::span<const std::byte> bytes, const std::string& name, const char* plugin) {
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(plugin);
  if (!input) fail_file(name, fmt::format("this OpenImageIO reads no {}", plugin));
  const auto fail_by_library = [&](const char* step) {
    const std::string message = first_line(input->geterror());
    fail_file(name, fmt::format("{} {}: {}", step, plugin, message.empty() ? "corrupt or truncated" : message));
  };
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  input->set_ioproxy(&memory);
  OIIO::ImageSpec spec;
  if (!input->open(std::string("memory.") + plugin, spec, config)) fail_by_library("cannot open");
  if (spec.width < 1 || spec.height < 1 || spec.width > kMaxImageSize || spec.height > kMaxImageSize || spec.depth > 1)
    fail_file(name, fmt::format("image size: expected 1x1 to {0}x{0}, got {1}x{2}", kMaxImageSize, spec.width, spec.height));
  if (spec.nchannels < 1 || spec.nchannels > 4) fail_file(name, fmt::format("image channels: expected 1 to 4, got {}", spec.nchannels));
  const ChannelType type = channel_type(spec.format, name);
  Image image(spec.width, spec.height, {type, spec.nchannels});
  const auto row_bytes = static_cast<OIIO::stride_t>(spec.width) * bytes_per_texel(image.format());
  // The file's first row is the top one: rows are read from our last one downwards.
  if (spec.format.basetype == OIIO::TypeDesc::INT16) {
    // The numbers themselves, as heights are stored; OpenImageIO would make shares of 32767 of them.
    const std::size_t row_values = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels);
    std::vector<std::int16_t> numbers(row_values * static_cast<std::size_t>(spec.height));
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::INT16, numbers.data())) fail_by_library("cannot decode");
    for (int y = 0; y < spec.height; ++y)
      std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(row_values * static_cast<std::size_t>(spec.height - 1 - y)), row_values,
                  image.channels<float>(0, y));
  } else if (!input->read_image(0, 0, 0, spec.nchannels, oiio_type(type), image.texel(0, spec.height - 1), OIIO::AutoStride, -row_bytes))
    fail_by_library("cannot decode");
  if (spec.nchannels == 2 && spec.alpha_channel == 1) return grey_alpha_expanded(image);
  return image;
}

std::string encode_by_oiio(const Image& image, const std::string& name, const char* plugin) {
  std::vector<unsigned char> buffer;
  OIIO::Filesystem::IOVecOutput memory(buffer);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(plugin);
  const auto fail_by_library = [&] {
    throw WriteError(fmt::format("{}: cannot write: {}", name, output ? first_line(output->geterror()) : first_line(OIIO::geterror())));
  };
  if (!output) fail_by_library();
  const OIIO::TypeDesc type = oiio_type(image.format().type);
  OIIO::ImageSpec spec(image.width(), image.height(), image.format().channels, type);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  if (image.format().channels == 2) spec.alpha_channel = -1;
  if (image.format().type == ChannelType::half) spec.attribute("tiff:half", 1);
  spec.attribute("DateTime", "");  // else the TIFF writer puts the time of day in, and the same image has other bytes
  output->set_ioproxy(&memory);
  if (!output->open(std::string("memory.") + plugin, spec)) fail_by_library();
  const auto row_bytes = static_cast<OIIO::stride_t>(image.width()) * bytes_per_texel(image.format());
  if (!output->write_image(type, image.texel(0, image.height() - 1), OIIO::AutoStride, -row_bytes)) fail_by_library();
  if (!output->close()) fail_by_library();
  return {reinterpret_cast<const char*>(buffer.data()), buffer.size()};
}

[[noreturn]] void refuse(const std::string& name, const Image& image, const char* what) {
  throw WriteError(fmt::format("{}: cannot write: {}, got {}", name, what, image.empty() ? "an empty image" : to_string(image.format())));
}

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

}  // namespace

Image decode_image(std::span<const std::byte> bytes, const std::string& name) {
  switch (format_of(bytes, name)) {
    case ImageFormat::png: check_png_structure(bytes, name); return decode_by_oiio(bytes, name, "png");
    case ImageFormat::jpeg: check_jpeg_structure(bytes, name); return decode_by_oiio(bytes, name, "jpeg");
    case ImageFormat::tiff: check_tiff_structure(bytes, name); return decode_by_oiio(bytes, name, "tiff");
    case ImageFormat::exr: return color_image(decode_exr(bytes, name), name);
  }
  fail_file(name, "unknown image format");
}

Image read_image(const fs::path& path) {
  const FileBytes content = read_file(path);
  return decode_image(content.bytes(), path.string());
}

std::string encode_png(const Image& image, const std::string& name) {
  const PixelFormat format = image.format();
  if (image.empty()) refuse(name, image, "expected an image");
  if (bytes_per_channel(format.type) > 2 || format.type == ChannelType::half || format.channels == 2)
    refuse(name, image, "PNG holds r, rgb or rgba of unorm8 or unorm16");
  return encode_by_oiio(image, name, "png");
}

void write_image(const fs::path& path, const Image& image) {
  const std::string name = path.string();
  const std::string extension = lower_extension(path);
  if (image.empty()) refuse(name, image, "expected an image");
  if (extension == ".png") return write_file(path, encode_png(image, name));
  if (extension == ".tif" || extension == ".tiff") return write_file(path, encode_by_oiio(image, name, "tiff"));
  if (extension != ".exr")
    throw WriteError(
        fmt::format("{}: cannot write: image format: expected .png, .tif, .tiff or .exr, got '{}'", name, printable(extension)));
  static const std::vector<std::string> kNames = {"R", "G", "B", "A"};
  ExrContent content;
  content.layers.push_back({{kNames.begin(), kNames.begin() + image.format().channels}, image});
  write_exr(path, content);
}

}  // namespace etalon::io
