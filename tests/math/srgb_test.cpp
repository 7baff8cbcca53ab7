#include "core/math/srgb.h"

#include <doctest/doctest.h>

using namespace etalon;

namespace {

std::uint8_t encode(float x) {
  const bool zero = x == 0;
  int exponent = 0;
  double m = x;
  while (!zero && m != static_cast<double>(static_cast<std::int64_t>(m))) m *= 2, ++exponent;
  const Quotient<4> q{WideInt<4>(static_cast<std::int64_t>(m)), WideInt<4>(1), exponent};
  return to_srgb8(q, enclose(q));
}

}  // namespace

TEST_CASE("every byte decodes to a number that encodes to the same byte") {
  for (int i = 0; i < 256; ++i) CHECK(encode(kSrgbDecode[i]) == i);
}

TEST_CASE("a threshold belongs to the upper byte, the float below it to the lower") {
  for (int k = 0; k < 255; ++k) {
    CHECK(encode(kSrgbThreshold[k]) == k + 1);
    CHECK(encode(std::nextafter(kSrgbThreshold[k], 0.0f)) == k);
  }
}

TEST_CASE("the ends of the curve") {
  CHECK(kSrgbDecode[0] == 0.0f);
  CHECK(kSrgbDecode[255] == 1.0f);
  CHECK(encode(7.5f) == 255);
}
