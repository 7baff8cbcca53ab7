// Correctly rounded decisions and conversions of an exact quotient N / (D · 2^k): floor, comparison with a double, and storage in
// float32, half or unorm. Each first tries double arithmetic with a proven interval and falls back to wide integers only where the
// interval straddles a border, so the result never depends on how it was found.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/math/half.h"
#include "core/math/wide_int.h"

namespace etalon {

/// The number n / (d · 2^k), d > 0. Widths: |n|·2^max(0,−k) and d·2^(54 + max(0,k)) must fit (raster/triangle_setup.cpp).
template <int kLimbs>
struct Quotient {
  WideInt<kLimbs> n;
  WideInt<kLimbs> d;
  int k = 0;
};

/// An interval of doubles that holds the exact number.
struct Interval {
  double lo;
  double hi;
};

/// 2^e as a double for −1022 <= e <= 1023, by its bits: no libm.
[[nodiscard]] inline double power_of_two(int e) { return std::bit_cast<double>(static_cast<std::uint64_t>(e + 1023) << 52); }

/// x · 2^e where neither x · 2^e nor half of that scaling leaves the normal range of double (exact).
[[nodiscard]] inline double scaled(double x, int e) {
  const int half = e / 2;
  return x * power_of_two(half) * power_of_two(e - half);
}

/// Encloses the quotient. Truncation of n and d (2^-63 each), their conversion (2^-53 each) and the division (2^-53) stay below 2^-51
/// together; the interval is widened by 2^-50 relative, more than the roundings of the widening itself.
template <int kLimbs>
[[nodiscard]] Interval enclose(const Quotient<kLimbs>& q) {
  if (q.n.zero()) return {0, 0};
  const auto n = q.n.leading();
  const auto d = q.d.leading();
  const double ratio = static_cast<double>(n.mantissa) / static_cast<double>(d.mantissa);
  const double magnitude = scaled(ratio, n.exponent - d.exponent - q.k);
  const double lo = magnitude * (1 - 0x1p-50), hi = magnitude * (1 + 0x1p-50);
  return q.n.negative() ? Interval{-hi, -lo} : Interval{lo, hi};
}

/// Sign of quotient − t, exact; t finite with |t| in [2^-200, 2^200] or 0. Only called for a t near the quotient, so both sides of the
/// integer comparison have nearly equal lengths and fit; unequal lengths are decided first, without shifting.
template <int kLimbs>
[[nodiscard]] int compare(const Quotient<kLimbs>& q, double t) {
  const int n_sign = q.n.sign();
  if (t == 0) return n_sign;
  const int t_sign = t < 0 ? -1 : 1;
  if (n_sign != t_sign) return n_sign < t_sign ? -1 : 1;
  // t = m · 2^e with a 53-bit integer m; compare |n| with m · d · 2^(k+e), then undo the sign.
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(t);
  std::int64_t m = static_cast<std::int64_t>((bits & 0x000FFFFFFFFFFFFFull) | 0x0010000000000000ull);
  int e = static_cast<int>(bits >> 52 & 0x7FF) - 1075;
  const int trailing = std::countr_zero(static_cast<std::uint64_t>(m));
  m >>= trailing, e += trailing;
  const WideInt<kLimbs> left = q.n.abs();
  const WideInt<kLimbs> right = q.d * WideInt<kLimbs>(m);
  const int shift = q.k + e;
  const int left_bits = left.bit_length() - (shift < 0 ? shift : 0);
  const int right_bits = right.bit_length() + (shift > 0 ? shift : 0);
  int result = 0;
  if (left_bits != right_bits)
    result = left_bits < right_bits ? -1 : 1;
  else if (shift >= 0)
    result = WideInt<kLimbs>::compare(left, right << shift);
  else
    result = WideInt<kLimbs>::compare(left << -shift, right);
  return result * t_sign;
}

/// floor of the quotient; |quotient| < 2^49, so that the enclosure is narrower than 1.
template <int kLimbs>
[[nodiscard]] std::int64_t floor_of(const Quotient<kLimbs>& q, Interval v) {
  const double lo = std::floor(v.lo), hi = std::floor(v.hi);
  if (lo == hi) return static_cast<std::int64_t>(lo);
  // The interval is narrower than 1, so hi = lo + 1 is the one border it can hold.
  return static_cast<std::int64_t>(compare(q, hi) >= 0 ? hi : lo);
}

/// Nearest float32, ties to even, subnormals kept; a stored zero is +0.
template <int kLimbs>
[[nodiscard]] float to_float32(const Quotient<kLimbs>& q, Interval v) {
  const float lo = static_cast<float>(v.lo), hi = static_cast<float>(v.hi);
  if (lo == hi) return lo + 0.0f;
  // Neighbouring floats: their middle is exact in double, and only it can lie in the interval.
  const int side = compare(q, (static_cast<double>(lo) + static_cast<double>(hi)) * 0.5);
  if (side != 0) return (side < 0 ? lo : hi) + 0.0f;
  return ((std::bit_cast<std::uint32_t>(lo) & 1) == 0 ? lo : hi) + 0.0f;
}

/// Nearest half (ties to even) or truncated; a stored zero is +0.
template <int kLimbs>
[[nodiscard]] std::uint16_t to_half(const Quotient<kLimbs>& q, Interval v, bool toward_zero) {
  const auto convert = [toward_zero](double x) {
    const std::uint16_t h = toward_zero ? half_toward_zero(x) : half_nearest_even(x);
    return h == 0x8000 ? std::uint16_t{0} : h;
  };
  const std::uint16_t lo = convert(v.lo), hi = convert(v.hi);
  if (lo == hi) return lo;
  const auto value = [](std::uint16_t h) { return (h & 0x7FFF) == 0x7C00 ? ((h & 0x8000) != 0 ? -65536.0 : 65536.0) : half_to_double(h); };
  const double a = value(lo), b = value(hi);
  if (toward_zero) {
    // The border is the one further from zero: reached means taken.
    const bool positive = b > 0;
    const double border = positive ? b : a;
    const int side = compare(q, border);
    return positive ? (side >= 0 ? hi : lo) : (side <= 0 ? lo : hi);
  }
  const int side = compare(q, (a + b) * 0.5);
  if (side != 0) return side < 0 ? lo : hi;
  return (lo & 1) == 0 ? lo : hi;
}

/// round(quotient · scale), ties to even, clamped to [0, scale]; scale 255 or 65535.
template <int kLimbs>
[[nodiscard]] std::uint32_t to_unorm(const Quotient<kLimbs>& q, Interval v, std::uint32_t scale) {
  if (v.hi <= 0) return 0;
  if (v.lo >= 1) return scale;
  // Products with the scale and + ½ add two roundings of 2^-53 of at most 65536; widened by 2^-34 > 2^-36 + 2^-37.
  const double s = scale;
  const double lo = std::floor(v.lo * s + 0.5 - 0x1p-34), hi = std::floor(v.hi * s + 0.5 + 0x1p-34);
  const auto clamp = [s](double x) { return static_cast<std::uint32_t>(x < 0 ? 0 : x > s ? s : x); };
  if (lo == hi) return clamp(lo);
  // The border between lo and hi is (2·hi − 1) / (2·scale); compare quotient · 2·scale with the integer 2·hi − 1.
  const Quotient<kLimbs> doubled{q.n * WideInt<kLimbs>(static_cast<std::int64_t>(scale)), q.d, q.k - 1};
  const int side = compare(doubled, 2 * hi - 1);
  if (side != 0) return clamp(side < 0 ? lo : hi);
  return clamp((static_cast<std::int64_t>(lo) & 1) == 0 ? lo : hi);
}

}  // namespace etalon
