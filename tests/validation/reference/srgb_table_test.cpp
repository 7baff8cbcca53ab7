#include "validation/reference/srgb_table.h"

#include <doctest/doctest.h>

#include <cmath>

namespace etalon::validation::reference {

namespace {

Fraction middle(float a, float b) {
  const Fraction x = exact(a), y = exact(b);
  return {x.n * y.d + y.n * x.d, 2 * x.d * y.d};
}

}  // namespace

TEST_CASE("decode: between the middles to both neighbours, and where libm's pow is") {
  const auto& table = srgb_decode();
  CHECK(table[0] == 0);
  CHECK(table[255] == 1);
  CHECK(table[10] == static_cast<float>(10.0 / 255 / 12.92));
  for (int i = 1; i < 256; ++i) {
    const float value = table[static_cast<std::size_t>(i)];
    CHECK(compare_srgb_curve(i, 255, middle(std::nextafter(value, 0.0f), value)) >= 0);
    CHECK(compare_srgb_curve(i, 255, middle(value, std::nextafter(value, 2.0f))) <= 0);
    const double x = i / 255.0, curve = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    CHECK(std::abs(value - curve) <= 0x1p-24 * curve);  // half an ulp of a float32 is at most 2^-24 of it
  }
}

TEST_CASE("thresholds: the smallest float32 not below the curve, ascending") {
  const auto& thresholds = srgb_thresholds();
  for (int k = 1; k <= 255; ++k) {
    const float t = thresholds[static_cast<std::size_t>(k - 1)];
    CHECK(compare_srgb_curve(2 * k - 1, 510, exact(t)) <= 0);
    CHECK(compare_srgb_curve(2 * k - 1, 510, exact(std::nextafter(t, 0.0f))) > 0);
    if (k > 1) CHECK(thresholds[static_cast<std::size_t>(k - 2)] < t);
  }
}

TEST_CASE("every byte survives decode and encode") {
  for (std::uint32_t i = 0; i < 256; ++i) CHECK(encode_srgb8(exact(srgb_decode()[i])) == i);
}

TEST_CASE("encode: a threshold belongs to the byte it opens") {
  for (std::uint32_t k = 1; k <= 255; ++k) {
    CHECK(encode_srgb8(exact(srgb_thresholds()[k - 1])) == k);
    CHECK(encode_srgb8(exact(std::nextafter(srgb_thresholds()[k - 1], 0.0f))) == k - 1);
  }
}

}  // namespace etalon::validation::reference
