// The arithmetic decoder of core/base, which knows how far its data are known: it decides a bit only when no continuation could change it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arithmetic_coder.h"

namespace etalon::wavelet {

/// Reads what ArithmeticEncoder wrote, of which only the first `known` bytes count. The bytes behind them are read too where they exist (so that
/// decoding can go on when more become known), zeros where not, but a bit is taken only if it is the same for all values of those bytes.
class PrefixDecoder {
 public:
  PrefixDecoder(std::span<const std::byte> bytes, std::size_t known) : bytes_(bytes), known_(known) {
    for (int i = 0; i < 4; ++i) value_ = (value_ << 8) | next();
  }

  /// True if the next bit, of P(1) = probability/2^16, follows from the known bytes.
  [[nodiscard]] bool is_determined(std::uint32_t probability) const {
    if (at_ <= known_) return true;
    const std::uint32_t unknown = unknown_bits(at_ - known_), middle = cut(probability);
    return ((value_ & ~unknown) <= middle) == ((value_ | unknown) <= middle);
  }
  /// Only where is_determined().
  [[nodiscard]] bool decode(std::uint32_t probability) {
    const std::uint32_t middle = cut(probability);
    const bool bit = value_ <= middle;
    if (bit)
      high_ = middle;
    else
      low_ = middle + 1;
    while (((low_ ^ high_) >> 24) == 0) {
      low_ <<= 8;
      high_ = (high_ << 8) | 0xFFu;
      value_ = (value_ << 8) | next();
    }
    return bit;
  }

  [[nodiscard]] std::size_t known_bytes() const { return known_; }
  void set_known_bytes(std::size_t known) { known_ = known; }

  /// The least number of bytes that determine all bits decoded so far.
  [[nodiscard]] std::size_t needed_bytes() const {
    std::size_t spare = 4;
    while (spare > 0 && ((value_ & ~unknown_bits(spare)) < low_ || (value_ | unknown_bits(spare)) > high_)) --spare;
    return at_ - spare;
  }

 private:
  static std::uint32_t unknown_bits(std::size_t bytes) { return bytes >= 4 ? 0xFFFFFFFFu : (1u << (8 * bytes)) - 1; }
  [[nodiscard]] std::uint32_t cut(std::uint32_t probability) const {
    return low_ + static_cast<std::uint32_t>((std::uint64_t{high_ - low_} * probability) >> 16);
  }
  std::uint32_t next() {
    const std::size_t at = at_++;
    return at < bytes_.size() ? std::to_integer<std::uint32_t>(bytes_[at]) : 0;
  }
  std::span<const std::byte> bytes_;
  std::size_t known_, at_ = 0;
  std::uint32_t low_ = 0, high_ = 0xFFFFFFFFu, value_ = 0;
};

}  // namespace etalon::wavelet
