// Small images with every value told apart, and PNG files built by hand, for what our writer does not write.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/base/rng.h"
#include "core/image/image.h"

namespace etalon::test {

/// Random texels; reals are finite and include values beyond [0, 1].
inline Image random_image(int width, int height, PixelFormat format, std::uint64_t seed) {
  Image image(width, height, format);
  Rng rng(seed);
  std::byte* at = image.bytes().data();
  const std::size_t count = image.texel_count() * static_cast<std::size_t>(format.channels);
  for (std::size_t i = 0; i < count; ++i) {
    switch (format.type) {
      case ChannelType::unorm8:
      case ChannelType::srgb8: at[i] = static_cast<std::byte>(rng.below(256)); break;
      case ChannelType::unorm16: {
        const auto v = static_cast<std::uint16_t>(rng.below(65536));
        std::memcpy(at + 2 * i, &v, 2);
        break;
      }
      case ChannelType::half: {
        const auto v = static_cast<std::uint16_t>(rng.below(0x7C00) | rng.below(2) << 15);  // below infinity, either sign
        std::memcpy(at + 2 * i, &v, 2);
        break;
      }
      case ChannelType::float32: {
        const float v = rng.uniform(-100, 100);
        std::memcpy(at + 4 * i, &v, 4);
        break;
      }
      case ChannelType::uint32: {
        const auto v = static_cast<std::uint32_t>(rng.next());
        std::memcpy(at + 4 * i, &v, 4);
        break;
      }
    }
  }
  return image;
}

inline std::string big_endian32(std::uint32_t v) {
  return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8), static_cast<char>(v)};
}

/// One PNG chunk with its CRC-32, computed bit by bit.
inline std::string png_chunk(const std::string& type, const std::string& data) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const char c : type + data) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? 0xEDB88320u ^ (crc >> 1) : crc >> 1;
  }
  return big_endian32(static_cast<std::uint32_t>(data.size())) + type + data + big_endian32(~crc);
}

/// A zlib stream of one stored block (RFC 1950, 1951).
inline std::string zlib_stored(const std::string& data) {
  std::uint32_t a = 1, b = 0;
  for (const char c : data) {
    a = (a + static_cast<std::uint8_t>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto n = static_cast<std::uint16_t>(data.size());
  const auto m = static_cast<std::uint16_t>(~n);
  std::string out = {
      '\x78', '\x01', '\x01', static_cast<char>(n), static_cast<char>(n >> 8), static_cast<char>(m), static_cast<char>(m >> 8)};
  return out + data + big_endian32(b << 16 | a);
}

/// A PNG file; `rows` is the unfiltered data without the filter bytes, `extra` the chunks before IDAT.
inline std::string png_file(std::uint32_t width, std::uint32_t height, int bit_depth, int color_type, const std::vector<std::string>& rows,
                            const std::string& extra = "") {
  std::string data;
  for (const std::string& row : rows) data += std::string(1, '\0') + row;
  const std::string header =
      big_endian32(width) + big_endian32(height) + std::string{static_cast<char>(bit_depth), static_cast<char>(color_type), 0, 0, 0};
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + extra + png_chunk("IDAT", zlib_stored(data)) + png_chunk("IEND", "");
}

}  // namespace etalon::test
