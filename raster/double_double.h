// Numbers as unevaluated sums of two doubles: some 100 bits for what one double leaves open. Dekker's and Knuth's error-free sums and
// products (Dekker 1971), which need arithmetic without contraction and ranges far from overflow.
#pragma once

#include <cstdint>

namespace etalon::raster {

struct DoubleDouble {
  double high = 0, low = 0;
};

/// a + b exactly.
[[nodiscard]] inline DoubleDouble two_sum(double a, double b) {
  const double sum = a + b, b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// a·b exactly, |a|, |b| below 2^900 and the product above 2^-900 or 0.
[[nodiscard]] inline DoubleDouble two_product(double a, double b) {
  const auto split = [](double x) {
    const double scaled = 134217729.0 * x, high = scaled - (scaled - x);
    return DoubleDouble{high, x - high};
  };
  const DoubleDouble p = split(a), q = split(b);
  const double product = a * b;
  return {product, ((p.high * q.high - product) + p.high * q.low + p.low * q.high) + p.low * q.low};
}

/// Each within 2^-100 of the larger operand (sums) or of the result (products, quotients).
[[nodiscard]] inline DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble high = two_sum(a.high, b.high), low = two_sum(a.low, b.low);
  const DoubleDouble once = two_sum(high.high, high.low + low.high);
  return two_sum(once.high, once.low + low.low);
}
[[nodiscard]] inline DoubleDouble operator*(DoubleDouble a, double b) {
  const DoubleDouble product = two_product(a.high, b);
  return two_sum(product.high, product.low + a.low * b);
}
[[nodiscard]] inline DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double first = a.high / b.high;
  const DoubleDouble rest = a + b * -first;
  const double second = rest.high / b.high;
  const DoubleDouble rest2 = rest + b * -second;
  return two_sum(first, second) + DoubleDouble{rest2.high / b.high, 0};
}

/// Exact.
[[nodiscard]] inline DoubleDouble double_double(std::int64_t a) {
  const std::int64_t low = a & 0xFFFFFFFF;
  return two_sum(static_cast<double>(a - low), static_cast<double>(low));
}

}  // namespace etalon::raster
