#include "core/image/image.h"

#include <fmt/format.h>

#include <cstring>

#include "core/base/error.h"
#include "core/base/sha256.h"

namespace etalon {

std::string to_string(ChannelType type) {
  switch (type) {
    case ChannelType::unorm8: return "unorm8";
    case ChannelType::srgb8: return "srgb8";
    case ChannelType::unorm16: return "unorm16";
    case ChannelType::half: return "half";
    case ChannelType::float32: return "float32";
    case ChannelType::uint32: return "uint32";
  }
  return "?";
}

std::string to_string(PixelFormat format) {
  static constexpr const char* kNames[] = {"r", "rg", "rgb", "rgba"};
  return fmt::format("{} {}", kNames[format.channels - 1], to_string(format.type));
}

Image::Image(int width, int height, PixelFormat format) : width_(width), height_(height), format_(format) {
  if (width < 1 || height < 1 || width > kMaxImageSize || height > kMaxImageSize)
    throw InputError(fmt::format("image size: expected 1x1 to {0}x{0}, got {1}x{2}", kMaxImageSize, width, height));
  if (format.channels < 1 || format.channels > 4) throw InputError(fmt::format("image channels: expected 1 to 4, got {}", format.channels));
  bytes_.resize(texel_count() * static_cast<std::size_t>(bytes_per_texel(format)));
}

std::string Image::sha256() const {
  Sha256 hash;
  const std::string header = fmt::format("etalon/image/1 {} {} {}\n", to_string(format_), width_, height_);
  hash.update(header.data(), header.size());
  hash.update(bytes_);
  return hash.hex();
}

std::size_t differing_texels(const Image& a, const Image& b) {
  ETALON_CHECK(a.format() == b.format() && a.width() == b.width() && a.height() == b.height(), "images of one size and format");
  const auto texel_bytes = static_cast<std::size_t>(bytes_per_texel(a.format()));
  std::size_t different = 0;
  for (std::size_t at = 0; at < a.bytes().size(); at += texel_bytes)
    different += std::memcmp(a.bytes().data() + at, b.bytes().data() + at, texel_bytes) != 0 ? 1 : 0;
  return different;
}

Image flipped_rows(const Image& image) {
  if (image.empty()) return image;
  Image result(image.width(), image.height(), image.format());
  const std::size_t row_bytes = static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(bytes_per_texel(image.format()));
  for (int y = 0; y < image.height(); ++y) std::memcpy(result.texel(0, y), image.texel(0, image.height() - 1 - y), row_bytes);
  return result;
}

}  // namespace etalon
