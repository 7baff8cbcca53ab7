// CRC-32 of IEEE 802.3, a byte at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace etalon::wavelet {

class Crc32 {
 public:
  void add(std::uint8_t byte) { state_ = kTable[(state_ ^ byte) & 0xFF] ^ (state_ >> 8); }
  [[nodiscard]] std::uint32_t value() const { return ~state_; }

 private:
  static constexpr std::array<std::uint32_t, 256> kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t c = i;
      for (int k = 0; k < 8; ++k) c = (c & 1) != 0 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
      table[i] = c;
    }
    return table;
  }();
  std::uint32_t state_ = 0xFFFFFFFFu;
};

[[nodiscard]] inline std::uint32_t crc32(std::span<const std::byte> bytes) {
  Crc32 crc;
  for (const std::byte b : bytes) crc.add(std::to_integer<std::uint8_t>(b));
  return crc.value();
}

}  // namespace etalon::wavelet
