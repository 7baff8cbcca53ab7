#include "validation/reference/rational.h"

#include <bit>
#include <cstring>

#include "validation/reference/srgb_table.h"
#include "validation/reference/stored_number.h"

namespace etalon::validation::reference {

namespace {

using boost::multiprecision::cpp_int;

BigRational rational_of(Binary b) { return b.e >= 0 ? BigRational(cpp_int(b.m) << b.e) : BigRational(cpp_int(b.m), cpp_int(1) << -b.e); }

// Bit patterns of non-negative numbers are ordered as the numbers; the pattern of infinity stands for the next power of two here.
BigRational float32_pattern(std::uint32_t bits) {
  return bits == 0x7F800000u ? BigRational(cpp_int(1) << 128) : rational_of_float32(std::bit_cast<float>(bits));
}
BigRational half_pattern(std::uint32_t bits) {
  return bits == 0x7C00u ? BigRational(65536) : rational_of_half(static_cast<std::uint16_t>(bits));
}

// The largest finite pattern whose number is not above x >= 0, where `compare(y)` is the sign of x − y.
template <class Pattern>
std::uint32_t pattern_below(const std::function<int(const BigRational&)>& compare, std::uint32_t infinity, Pattern number) {
  std::uint32_t low = 0, high = infinity;
  while (high - low > 1) {
    const std::uint32_t middle = low + (high - low) / 2;
    if (compare(number(middle)) >= 0)
      low = middle;
    else
      high = middle;
  }
  return low;
}

// The nearer of that pattern and the next; in the middle the even one.
template <class Pattern>
std::uint32_t nearest_pattern(const std::function<int(const BigRational&)>& compare, std::uint32_t infinity, Pattern number) {
  const std::uint32_t below = pattern_below(compare, infinity, number), above = below + 1;
  const int side = compare((number(below) + number(above)) / 2);
  if (side == 0) return below % 2 == 0 ? below : above;
  return side < 0 ? below : above;
}

std::function<int(const BigRational&)> comparison_with(const BigRational& q) {
  return [&q](const BigRational& y) { return q.compare(y); };
}

// "round(x·255)", half to even, after "clamp to [0, 1]"
std::uint32_t unorm(const BigRational& value, int steps) {
  const BigRational clamped = value < 0 ? BigRational(0) : value > 1 ? BigRational(1) : value;
  const BigRational scaled = clamped * steps, below = floor_of(scaled);
  const auto i = numerator(below).convert_to<std::uint32_t>();
  const int side = BigRational(scaled - below).compare(BigRational(1, 2));
  return side < 0 || (side == 0 && i % 2 == 0) ? i : i + 1;
}

std::uint32_t srgb8(const BigRational& value) {
  std::uint32_t count = 0;
  for (const float threshold : srgb_thresholds()) count += rational_of_float32(threshold) <= value ? 1 : 0;
  return count;
}

std::uint32_t half(const BigRational& value, HalfRounding rounding) {
  const BigRational magnitude = abs(value);
  const auto compare = comparison_with(magnitude);
  const std::uint32_t bits =
      rounding == HalfRounding::toward_zero ? pattern_below(compare, 0x7C00, half_pattern) : nearest_pattern(compare, 0x7C00, half_pattern);
  return value < 0 && bits != 0 ? bits + 0x8000 : bits;
}

}  // namespace

BigRational rational_of_float32(float value) { return rational_of(binary_of_float32(value)); }
BigRational rational_of_half(std::uint16_t bits) { return rational_of(binary_of_half(bits)); }

BigRational floor_of(const BigRational& q) {
  cpp_int whole = numerator(q) / denominator(q);
  if (BigRational(whole) > q) whole -= 1;
  return BigRational(whole);
}

float nearest_float32(const std::function<int(const BigRational&)>& compare) {
  return std::bit_cast<float>(nearest_pattern(compare, 0x7F800000u, float32_pattern));
}

float nearest_float32(const BigRational& q) {
  const BigRational magnitude = abs(q);
  const float rounded = nearest_float32(comparison_with(magnitude));
  return q < 0 && rounded != 0 ? -rounded : rounded;
}

void store_rational(const BigRational& value, PixelFormat format, int channel, HalfRounding half_rounding, std::byte* texel) {
  const bool alpha = channel == 3;
  std::uint32_t bits = 0;
  switch (format.type) {
    case ChannelType::unorm8: bits = unorm(value, 255); break;
    case ChannelType::srgb8: bits = alpha ? unorm(value, 255) : srgb8(value); break;
    case ChannelType::unorm16: bits = unorm(value, 65535); break;
    case ChannelType::half: bits = half(value, half_rounding); break;
    case ChannelType::float32: bits = std::bit_cast<std::uint32_t>(nearest_float32(value)); break;
    case ChannelType::uint32: throw_check_failed(__FILE__, __LINE__, "a number is stored in a format of numbers", to_string(format));
  }
  const auto size = static_cast<std::size_t>(bytes_per_channel(format.type));
  const std::size_t skipped = std::endian::native == std::endian::big ? sizeof bits - size : 0;  // bytes of value 0
  std::memcpy(texel + static_cast<std::size_t>(channel) * size, reinterpret_cast<const std::byte*>(&bits) + skipped, size);
}

}  // namespace etalon::validation::reference
