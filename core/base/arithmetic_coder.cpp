#include "core/base/arithmetic_coder.h"

#include <utility>

namespace etalon {

namespace {

constexpr std::uint32_t kEven = 32768;

// Bits of x >= 1.
int bit_length(std::uint32_t x) {
  int n = 0;
  for (; x != 0; x >>= 1) ++n;
  return n;
}

}  // namespace

void ArithmeticEncoder::encode_even(std::uint32_t value, int count) {
  for (int i = count - 1; i >= 0; --i) encode(((value >> i) & 1u) != 0, kEven);
}

std::uint32_t ArithmeticDecoder::decode_even(int count) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) value = (value << 1) | (decode(kEven) ? 1u : 0u);
  return value;
}

std::string ArithmeticEncoder::finish() {
  // The first bytes of low and high differ: one more than low's, and zeros, is above low and not above high.
  if (low_ != 0) bytes_.push_back(static_cast<char>((low_ >> 24) + 1));
  low_ = 0;
  high_ = 0xFFFFFFFFu;
  return std::exchange(bytes_, {});
}

void AdaptiveInteger::encode(std::int32_t value, ArithmeticEncoder& out) {
  out.encode(value == 0, zero_);
  if (value == 0) return;
  out.encode(value < 0, sign_);
  const std::uint32_t magnitude = value < 0 ? 0u - static_cast<std::uint32_t>(value) : static_cast<std::uint32_t>(value);
  const int length = bit_length(magnitude);
  for (int i = 1; i < length; ++i) out.encode(true, longer_[static_cast<std::size_t>(i - 1)]);
  if (length < 31) out.encode(false, longer_[static_cast<std::size_t>(length - 1)]);
  std::array<AdaptiveBit, 3>& high = high_bits_[static_cast<std::size_t>(length)];
  if (length < 2) return;
  const bool first = ((magnitude >> (length - 2)) & 1u) != 0;
  out.encode(first, high[0]);
  if (length < 3) return;
  out.encode(((magnitude >> (length - 3)) & 1u) != 0, high[first ? 2 : 1]);
  out.encode_even(magnitude, length - 3);
}

std::int32_t AdaptiveInteger::decode(ArithmeticDecoder& in) {
  if (in.decode(zero_)) return 0;
  const bool negative = in.decode(sign_);
  int length = 1;
  while (length < 31 && in.decode(longer_[static_cast<std::size_t>(length - 1)])) ++length;
  std::array<AdaptiveBit, 3>& high = high_bits_[static_cast<std::size_t>(length)];
  std::uint32_t magnitude = 1;
  if (length >= 2) magnitude = 2 | (in.decode(high[0]) ? 1u : 0u);
  if (length >= 3) {
    const bool second = in.decode(high[(magnitude & 1u) != 0 ? 2 : 1]);
    magnitude = (magnitude << 1) | (second ? 1u : 0u);
    magnitude = (magnitude << (length - 3)) | in.decode_even(length - 3);
  }
  const auto value = static_cast<std::int32_t>(magnitude);
  return negative ? -value : value;
}

}  // namespace etalon
