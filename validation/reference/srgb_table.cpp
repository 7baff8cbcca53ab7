#include "validation/reference/srgb_table.h"

#include <bit>
#include <cstdint>

#include "validation/reference/fraction.h"

namespace etalon::validation::reference {

namespace {

BigInt to_the(const BigInt& base, int exponent) {
  BigInt product = 1;
  for (int n = 0; n < exponent; ++n) product *= base;
  return product;
}

float float_of_bits(std::uint32_t bits) { return std::bit_cast<float>(bits); }

// The bits of the smallest float32 y >= 0 with curve <= y. Non-negative float32 are ordered as their bits.
std::uint32_t smallest_not_below(int numerator, int denominator) {
  std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(1.0f);  // curve <= float(high) always
  while (low < high) {
    const std::uint32_t middle = low + (high - low) / 2;
    if (compare_srgb_curve(numerator, denominator, exact(float_of_bits(middle))) <= 0)
      high = middle;
    else
      low = middle + 1;
  }
  return high;
}

std::array<float, 256> make_decode() {
  std::array<float, 256> table{};
  for (int i = 1; i < 256; ++i) {  // the curve is 0 at 0
    const std::uint32_t above = smallest_not_below(i, 255), below = above - 1;
    const Fraction lo = exact(float_of_bits(below)), hi = exact(float_of_bits(above));
    const int side = compare_srgb_curve(i, 255, Fraction{lo.n * hi.d + hi.n * lo.d, 2 * lo.d * hi.d});
    table[static_cast<std::size_t>(i)] = float_of_bits(side < 0 || (side == 0 && (below & 1) == 0) ? below : above);
  }
  return table;
}

std::array<float, 255> make_thresholds() {
  std::array<float, 255> table{};
  for (int k = 1; k <= 255; ++k) table[static_cast<std::size_t>(k - 1)] = float_of_bits(smallest_not_below(2 * k - 1, 510));
  return table;
}

}  // namespace

int compare_srgb_curve(int numerator, int denominator, const Fraction& y) {
  if (100000LL * numerator <= 4045LL * denominator)
    return BigInt(BigInt(100 * numerator) * y.d).compare(BigInt(BigInt(1292) * denominator * y.n));
  const BigInt n = BigInt(1000) * numerator + BigInt(55) * denominator, d = BigInt(1055) * denominator;
  return BigInt(to_the(n, 12) * to_the(y.d, 5)).compare(BigInt(to_the(y.n, 5) * to_the(d, 12)));
}

const std::array<float, 256>& srgb_decode() {
  static const std::array<float, 256> kTable = make_decode();
  return kTable;
}

const std::array<float, 255>& srgb_thresholds() {
  static const std::array<float, 255> kTable = make_thresholds();
  return kTable;
}

}  // namespace etalon::validation::reference
