// IEEE binary16 from and to double; every half is a double, so the way back is exact.
#pragma once

#include <bit>
#include <cstdint>

namespace etalon {

/// The double a half stands for, inf and NaN included.
[[nodiscard]] constexpr double half_to_double(std::uint16_t h) {
  const std::uint64_t sign = static_cast<std::uint64_t>(h >> 15) << 63;
  const std::uint64_t exponent = (h >> 10) & 31, mantissa = h & 1023;
  if (exponent == 31) return std::bit_cast<double>(sign | 0x7FF0000000000000ull | mantissa << 42);
  if (exponent == 0) {
    const double magnitude = static_cast<double>(mantissa) * 0x1p-24;
    return sign != 0 ? -magnitude : magnitude;
  }
  return std::bit_cast<double>(sign | (exponent + 1008) << 52 | mantissa << 42);
}

/// The largest half magnitude not above |x|, with the sign of x; |x| >= 65504 gives 65504. x finite.
[[nodiscard]] constexpr std::uint16_t half_toward_zero(double x) {
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  const auto sign = static_cast<std::uint16_t>(bits >> 48 & 0x8000);
  const double magnitude = x < 0 ? -x : x + 0.0;  // −0 becomes 0
  if (magnitude >= 65504.0) return sign | 0x7BFF;
  if (magnitude < 0x1p-14) return sign | static_cast<std::uint16_t>(magnitude * 0x1p24);
  const std::uint64_t m = std::bit_cast<std::uint64_t>(magnitude);
  return sign | static_cast<std::uint16_t>(((m >> 52) - 1008) << 10 | (m >> 42 & 1023));
}

/// The half nearest to x, ties to even; |x| >= 65520 gives inf. x finite.
[[nodiscard]] constexpr std::uint16_t half_nearest_even(double x) {
  const double magnitude = x < 0 ? -x : x + 0.0;  // −0 becomes 0
  const auto sign = static_cast<std::uint16_t>(std::bit_cast<std::uint64_t>(x) >> 48 & 0x8000);
  if (magnitude >= 65520.0) return sign | 0x7C00;
  const auto below = static_cast<std::uint16_t>(half_toward_zero(magnitude));
  const double lo = half_to_double(below);
  // Above 65504 comes 65536, which the encoding calls inf; its midpoint was handled first.
  const double hi = below == 0x7BFF ? 65536.0 : half_to_double(static_cast<std::uint16_t>(below + 1));
  const double middle = (lo + hi) * 0.5;  // exact: 12 significant bits
  const bool up = magnitude > middle || (magnitude == middle && (below & 1) != 0);
  return sign | static_cast<std::uint16_t>(below + (up ? 1 : 0));
}

}  // namespace etalon
