// Adaptive binary arithmetic coding: bits in, bytes out, and back, the same bytes on every machine. Integers only.
//
// The coder keeps an interval [low, high] of 32-bit numbers and cuts it at low + (high − low)·P(1); what follows is the lower part for a 1, the
// upper for a 0. Leading bytes on which both ends agree are settled and leave; so no carry can ever reach a byte that has left [Mahoney 2005,
// "Adaptive weighing of context models", sec. 3.2]. Where the ends straddle a byte border the interval gets short, at worst two numbers, each of
// which is a part: a bit then costs up to 32 bits; over random data the loss is below 2^-12 bit a bit.
//
// Flush: the fewest bytes which, read with zeros behind them, lie in the interval: none where low is 0, else the one byte that is 1 above low's
// first. So whole data of n bytes are read with 3 or 4 bytes past their end, and more past it proves that they were cut or are no such data.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace etalon {

/// Probability of a 1 in one context, learnt from its bits: the mean of a fast estimate (rate 1/n down to 1/16) and a slow one (down to 1/128).
class AdaptiveBit {
 public:
  /// P(1)·2^16, in [32, 65504]; ½ before the first bit.
  [[nodiscard]] std::uint32_t probability() const {
    const std::uint32_t mean = (std::uint32_t{fast_} + slow_) / 2;
    return mean < 32 ? 32 : (mean > 65504 ? 65504 : mean);
  }
  void learn(bool bit) {
    const std::int32_t target = bit ? 65535 : 0;
    fast_ = moved(fast_, target, count_ < kFast ? count_ : kFast);
    slow_ = moved(slow_, target, count_);
    if (count_ < kSlow) ++count_;
  }
  friend bool operator==(const AdaptiveBit&, const AdaptiveBit&) = default;

 private:
  static constexpr std::uint8_t kFast = 14, kSlow = 126;
  static constexpr std::array<std::int32_t, kSlow + 1> kRates = [] {
    std::array<std::int32_t, kSlow + 1> rates{};
    for (std::int32_t n = 0; n <= kSlow; ++n) rates[static_cast<std::size_t>(n)] = 65536 / (n + 2);
    return rates;
  }();
  // Rounds down, so p stays in [0, 65535]; |target − p|·rate <= 65535·32768 < 2^31.
  static std::uint16_t moved(std::int32_t p, std::int32_t target, std::uint8_t count) {
    return static_cast<std::uint16_t>(p + (((target - p) * kRates[count]) >> 16));
  }
  std::uint16_t fast_ = 32768, slow_ = 32768;
  std::uint8_t count_ = 0;
};

class ArithmeticEncoder {
 public:
  /// One bit with P(1) = probability / 2^16, probability in 1..65535 (unchecked).
  void encode(bool bit, std::uint32_t probability) {
    const std::uint32_t middle = low_ + static_cast<std::uint32_t>((std::uint64_t{high_ - low_} * probability) >> 16);
    if (bit)
      high_ = middle;
    else
      low_ = middle + 1;
    while (((low_ ^ high_) >> 24) == 0) {
      bytes_.push_back(static_cast<char>(high_ >> 24));
      low_ <<= 8;
      high_ = (high_ << 8) | 0xFFu;
    }
  }
  void encode(bool bit, AdaptiveBit& context) {
    encode(bit, context.probability());
    context.learn(bit);
  }
  /// `count` (0..32) bits of even odds, the most significant first.
  void encode_even(std::uint32_t value, int count);

  /// Bytes that have left; the interval holds up to 4 more. What a budget is compared with.
  [[nodiscard]] std::size_t settled_bytes() const { return bytes_.size(); }
  /// Flushes, hands out the bytes and starts anew. Nothing coded: no bytes.
  [[nodiscard]] std::string finish();

 private:
  std::uint32_t low_ = 0, high_ = 0xFFFFFFFFu;
  std::string bytes_;
};

/// Reads what ArithmeticEncoder wrote, by the same calls in the same order. Never throws: past the end it reads zeros and counts them. Zeros can
/// be decoded for ever: whoever loops has a limit of its own.
class ArithmeticDecoder {
 public:
  explicit ArithmeticDecoder(std::span<const std::byte> bytes) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) value_ = (value_ << 8) | next();
  }

  [[nodiscard]] bool decode(std::uint32_t probability) {
    const std::uint32_t middle = low_ + static_cast<std::uint32_t>((std::uint64_t{high_ - low_} * probability) >> 16);
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
  [[nodiscard]] bool decode(AdaptiveBit& context) {
    const bool bit = decode(context.probability());
    context.learn(bit);
    return bit;
  }
  [[nodiscard]] std::uint32_t decode_even(int count);

  /// Zeros read behind the data.
  [[nodiscard]] std::size_t bytes_past_end() const { return past_end_; }
  /// True if more was decoded than whole data could hold: they were cut, or are none. False proves nothing: the zeros behind a cut may decode to
  /// bits that cost little, so a stream also says how much of it there is.
  [[nodiscard]] bool exhausted() const { return past_end_ > 4; }
  /// True if all bytes have been read, and not more than whole data give: what must hold behind the last bit of whole data.
  [[nodiscard]] bool at_end() const { return at_ == bytes_.size() && past_end_ >= 3 && past_end_ <= 4; }

 private:
  std::uint32_t next() {
    if (at_ < bytes_.size()) return std::to_integer<std::uint32_t>(bytes_[at_++]);
    ++past_end_;
    return 0;
  }
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0, past_end_ = 0;
  std::uint32_t low_ = 0, high_ = 0xFFFFFFFFu, value_ = 0;
};

/// Context models of one signed integer: zero?, sign, then the magnitude's number of bits in unary (adaptive) and its bits behind the leading
/// one (the first two adaptive, the rest even). |value| < 2^31.
class AdaptiveInteger {
 public:
  void encode(std::int32_t value, ArithmeticEncoder& out);
  /// Any bits give some value in range.
  [[nodiscard]] std::int32_t decode(ArithmeticDecoder& in);

 private:
  AdaptiveBit zero_, sign_;
  std::array<AdaptiveBit, 31> longer_;
  std::array<std::array<AdaptiveBit, 3>, 32> high_bits_;  ///< by length: the first bit, and the second by the first
};

}  // namespace etalon
