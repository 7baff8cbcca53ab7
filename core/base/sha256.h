// SHA-256 (FIPS 180-4): names inputs, goldens and the draw list a margins file belongs to.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace etalon {

/// Incremental hash; feed with update(), close with hex(). Not for secrets.
class Sha256 {
 public:
  Sha256();
  void update(std::span<const std::byte> bytes);
  void update(const void* data, std::size_t size_bytes);
  /// The digest as 64 lowercase hex digits; the object must not be used afterwards.
  [[nodiscard]] std::string hex();

 private:
  void compress(const unsigned char* block);
  std::array<std::uint32_t, 8> state_;
  std::array<unsigned char, 64> block_{};
  std::size_t fill_ = 0;
  std::uint64_t length_bytes_ = 0;
};

[[nodiscard]] std::string sha256_hex(std::span<const std::byte> bytes);

}  // namespace etalon
