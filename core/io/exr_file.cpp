#include "core/io/exr_file.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>
#include <half.h>

#include <cstring>
#include <optional>
#include <set>
#include <utility>

#include "core/base/error.h"
#include "core/io/atomic_file.h"
#include "core/io/image_structure.h"
#include "core/io/input_error.h"
#include "core/io/inputs.h"

namespace etalon::io {
namespace {

namespace fs = std::filesystem;

class MemoryInput : public Imf::IStream {
 public:
  MemoryInput(std::span<const std::byte> bytes, const std::string& name) : Imf::IStream(name.c_str()), bytes_(bytes) {}
  bool read(char out[], int count) override {
    if (count < 0 || bytes_.size() - at_ < static_cast<std::size_t>(count)) throw InputError("the file ends early");
    std::memcpy(out, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return at_ < bytes_.size();
  }
  uint64_t tellg() override { return at_; }
  void seekg(uint64_t position) override {
    if (position > bytes_.size()) throw InputError(fmt::format("offset {}: expected at most {}", position, bytes_.size()));
    at_ = static_cast<std::size_t>(position);
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

class MemoryOutput : public Imf::OStream {
 public:
  explicit MemoryOutput(const std::string& name) : Imf::OStream(name.c_str()) {}
  void write(const char in[], int count) override {
    const auto end = at_ + static_cast<std::size_t>(count);
    if (bytes_.size() < end) bytes_.resize(end);
    std::memcpy(bytes_.data() + at_, in, static_cast<std::size_t>(count));
    at_ = end;
  }
  uint64_t tellp() override { return at_; }
  void seekp(uint64_t position) override { at_ = static_cast<std::size_t>(position); }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

std::optional<Imf::PixelType> pixel_type(ChannelType type) {
  switch (type) {
    case ChannelType::half: return Imf::HALF;
    case ChannelType::float32: return Imf::FLOAT;
    case ChannelType::uint32: return Imf::UINT;
    default: return std::nullopt;
  }
}

ChannelType channel_type(Imf::PixelType type, const std::string& name) {
  switch (type) {
    case Imf::HALF: return ChannelType::half;
    case Imf::FLOAT: return ChannelType::float32;
    case Imf::UINT: return ChannelType::uint32;
    default: fail_file(name, "channel type: expected half, float or uint32");
  }
}

void check_content(const ExrContent& content, const std::string& file) {
  const auto refuse = [&](const std::string& what) { throw WriteError(fmt::format("{}: cannot write: {}", file, what)); };
  if (content.layers.empty()) refuse("expected at least one channel, got none");
  std::set<std::string> seen;
  for (const ExrLayer& layer : content.layers) {
    const Image& first = content.layers.front().image;
    if (layer.image.empty()) refuse("expected an image, got an empty one");
    if (layer.image.width() != first.width() || layer.image.height() != first.height())
      refuse(fmt::format("layers: expected {}x{}, got {}x{}", first.width(), first.height(), layer.image.width(), layer.image.height()));
    if (layer.channel_names.size() != static_cast<std::size_t>(layer.image.format().channels))
      refuse(fmt::format("channel names: expected {}, got {}", layer.image.format().channels, layer.channel_names.size()));
    if (!pixel_type(layer.image.format().type))
      refuse(fmt::format("EXR holds half, float32 or uint32, got {}", to_string(layer.image.format())));
    for (const std::string& name : layer.channel_names) {
      if (name.empty() || name.size() > 255) refuse(fmt::format("channel name: expected 1 to 255 bytes, got {}", name.size()));
      if (!seen.insert(name).second) refuse(fmt::format("channel '{}' is there twice", printable(name)));
    }
  }
}

/// Where OpenEXR finds texel (x, y): base + x·x_stride + y·y_stride; the file's row 0 is our last one, so y runs downwards.
Imf::Slice slice_of(const Image& image, int channel, Imf::PixelType type, const Imath::Box2i& window) {
  const auto x_stride = static_cast<std::ptrdiff_t>(bytes_per_texel(image.format()));
  const std::ptrdiff_t y_stride = -x_stride * image.width();
  const std::byte* top_left = image.texel(0, image.height() - 1) + channel * bytes_per_channel(image.format().type);
  // Unsigned wrap-around is how OpenEXR takes negative strides.
  char* base = reinterpret_cast<char*>(reinterpret_cast<std::uintptr_t>(top_left) - static_cast<std::uintptr_t>(window.min.x * x_stride) -
                                       static_cast<std::uintptr_t>(window.min.y * y_stride));
  return {type, base, static_cast<std::size_t>(x_stride), static_cast<std::size_t>(y_stride)};
}

ExrContent decode_checked(std::span<const std::byte> bytes, const std::string& name) {
  MemoryInput stream(bytes, name);
  Imf::InputFile file(stream, 0);
  const Imath::Box2i window = file.header().dataWindow();
  ExrContent content;
  Imf::FrameBuffer frame;
  const Imf::ChannelList& channels = file.header().channels();
  // A corrupt header may list any number of channels; each needs its texels in the file, at the best ratio of its codecs (deflate, 1032).
  std::size_t texel_bytes = 0;
  for (auto c = channels.begin(); c != channels.end(); ++c)
    texel_bytes += static_cast<std::size_t>(bytes_per_channel(channel_type(c.channel().type, name)));
  const std::size_t width = static_cast<std::size_t>(window.max.x - window.min.x) + 1;
  const std::size_t height = static_cast<std::size_t>(window.max.y - window.min.y) + 1;
  if (texel_bytes == 0) fail_file(name, "expected at least one channel, got none");
  // DWA keeps one number of 64 where a block is flat, before it deflates.
  const Imf::Compression codec = file.header().compression();
  const std::size_t ratio = codec == Imf::DWAA_COMPRESSION || codec == Imf::DWAB_COMPRESSION ? 64 * 1032 : 1032;
  if (texel_bytes * width * height / ratio > bytes.size())
    fail_file(name, fmt::format("expected at least {} bytes for its size and channels, got {}", texel_bytes * width * height / ratio,
                                bytes.size()));
  // Scanline blocks hold at most 256 rows (DWAB); every block has an 8-byte offset in the table and an 8-byte head.
  if ((height + 255) / 256 * 16 > bytes.size()) fail_file(name, fmt::format("{} rows do not fit into {} bytes", height, bytes.size()));
  for (auto c = channels.begin(); c != channels.end(); ++c) {
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
      fail_file(name, fmt::format("channel '{}': expected full sampling, got {}x{}", printable(c.name()), c.channel().xSampling,
                                  c.channel().ySampling));
    content.layers.push_back(
        {{c.name()}, Image(static_cast<int>(width), static_cast<int>(height), {channel_type(c.channel().type, name), 1})});
  }
  for (const ExrLayer& layer : content.layers)
    frame.insert(layer.channel_names[0], slice_of(layer.image, 0, *pixel_type(layer.image.format().type), window));
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  for (auto a = file.header().begin(); a != file.header().end(); ++a)
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute())) content.attributes[a.name()] = text->value();
  return content;
}

struct ChannelRef {
  const Image* image = nullptr;
  int channel = 0;
};

ChannelRef find_channel(const ExrContent& content, const std::string& channel_name) {
  for (const ExrLayer& layer : content.layers)
    for (std::size_t i = 0; i < layer.channel_names.size(); ++i)
      if (layer.channel_names[i] == channel_name) return {&layer.image, static_cast<int>(i)};
  return {};
}

std::string name_list(const ExrContent& content) {
  std::string list;
  for (const ExrLayer& layer : content.layers)
    for (const std::string& n : layer.channel_names) list += (list.empty() ? "" : ", ") + printable(n);
  return list.substr(0, 300);
}

}  // namespace

void write_exr(const fs::path& path, const ExrContent& content) {
  const std::string file = path.string();
  check_content(content, file);
  const Image& first = content.layers.front().image;
  MemoryOutput stream(file);
  try {
    Imf::Header header(first.width(), first.height());
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame;
    for (const ExrLayer& layer : content.layers)
      for (std::size_t i = 0; i < layer.channel_names.size(); ++i) {
        const Imf::PixelType type = *pixel_type(layer.image.format().type);
        header.channels().insert(layer.channel_names[i], Imf::Channel(type));
        frame.insert(layer.channel_names[i], slice_of(layer.image, static_cast<int>(i), type, header.dataWindow()));
      }
    for (const auto& [key, value] : content.attributes) header.insert(key, Imf::StringAttribute(value));
    Imf::OutputFile output(stream, header, 0);
    output.setFrameBuffer(frame);
    output.writePixels(first.height());
  } catch (const std::exception& error) {
    throw WriteError(fmt::format("{}: cannot write: {}", file, first_line(error.what())));
  }
  write_file(path, stream.bytes());
}

ExrContent decode_exr(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.size() < 4 || std::memcmp(bytes.data(), "\x76\x2f\x31\x01", 4) != 0)
    fail_at_byte(name, 0, "expected OpenEXR's magic number 76 2f 31 01");
  check_exr_structure(bytes, name);
  try {
    return decode_checked(bytes, name);
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (message.starts_with(name)) throw;
    fail_file(name, fmt::format("cannot decode OpenEXR: {}", message));
  } catch (const std::exception& error) {
    fail_file(name, fmt::format("cannot decode OpenEXR: {}", first_line(error.what())));
  }
}

ExrContent read_exr(const fs::path& path) {
  const FileBytes content = read_file(path);
  return decode_exr(content.bytes(), path.string());
}

Image channels_image(const ExrContent& content, const std::vector<std::string>& channel_names, const std::string& name) {
  std::vector<ChannelRef> refs;
  for (const std::string& n : channel_names) {
    refs.push_back(find_channel(content, n));
    if (refs.back().image == nullptr) fail_file(name, fmt::format("expected a channel '{}', got {}", printable(n), name_list(content)));
  }
  if (refs.empty()) fail_file(name, "expected at least one channel name, got none");
  ChannelType type = refs[0].image->format().type;
  for (const ChannelRef& r : refs) {
    const ChannelType other = r.image->format().type;
    if ((other == ChannelType::uint32) != (type == ChannelType::uint32))
      fail_file(name, "expected channels of like type, got uint32 beside real ones");
    if (other != type) type = ChannelType::float32;
  }
  Image result(refs[0].image->width(), refs[0].image->height(), {type, static_cast<int>(refs.size())});
  const auto size = static_cast<std::size_t>(bytes_per_channel(type));
  for (int y = 0; y < result.height(); ++y)
    for (int x = 0; x < result.width(); ++x)
      for (std::size_t c = 0; c < refs.size(); ++c) {
        const Image& source = *refs[c].image;
        std::byte* out = result.texel(x, y) + c * size;
        const std::byte* in = source.texel(x, y) + refs[c].channel * bytes_per_channel(source.format().type);
        if (source.format().type == type) {
          std::memcpy(out, in, size);
        } else {
          half h;
          std::memcpy(static_cast<void*>(&h), in, sizeof h);
          const float wide = h;  // every half is a float
          std::memcpy(out, &wide, sizeof wide);
        }
      }
  return result;
}

Image color_image(const ExrContent& content, const std::string& name) {
  std::vector<std::string> names;
  for (const char* n : {"R", "G", "B", "A"})
    if (find_channel(content, n).image != nullptr)
      names.emplace_back(n);
    else
      break;
  if (names.empty() && find_channel(content, "Y").image != nullptr) names = {"Y"};
  if (names.empty()) fail_file(name, fmt::format("expected colour channels R, RG, RGB, RGBA or Y, got {}", name_list(content)));
  return channels_image(content, names, name);
}

}  // namespace etalon::io
