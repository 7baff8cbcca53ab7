// A damaged PNG with the checksums of its chunks made right, so that the damage reaches the decoder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/progressive/epm_format.h"

namespace etalon::test {

inline std::vector<std::byte> with_png_checksums(std::span<const std::byte> png) {
  std::vector<std::byte> result(png.begin(), png.end());
  for (std::size_t at = 8; at + 12 <= result.size();) {
    std::size_t length = 0;
    for (std::size_t k = 0; k < 4; ++k) length = length << 8 | std::to_integer<std::size_t>(result[at + k]);
    if (length > result.size() - at - 12) break;
    const std::uint32_t crc = progressive::crc32(std::span(result).subspan(at + 4, 4 + length));
    for (std::size_t k = 0; k < 4; ++k) result[at + 8 + length + k] = static_cast<std::byte>(crc >> (24 - 8 * k) & 0xFF);
    at += 12 + length;
  }
  return result;
}

}  // namespace etalon::test
