#include "core/math/half.h"

#include <doctest/doctest.h>

using namespace etalon;

TEST_CASE("every finite half survives the way to double and back, under both roundings") {
  for (std::uint32_t h = 0; h < 0x10000; ++h) {
    const auto bits = static_cast<std::uint16_t>(h);
    if ((bits & 0x7C00) == 0x7C00) continue;
    REQUIRE(half_nearest_even(half_to_double(bits)) == bits);
    REQUIRE(half_toward_zero(half_to_double(bits)) == bits);
  }
}

TEST_CASE("between two neighbours: middle to even, truncation to the lower") {
  for (std::uint32_t h = 0; h < 0x7BFF; ++h) {
    const double lo = half_to_double(static_cast<std::uint16_t>(h)), hi = half_to_double(static_cast<std::uint16_t>(h + 1));
    const double middle = (lo + hi) / 2, step = (hi - lo) * 0x1p-20;
    REQUIRE(half_nearest_even(middle) == ((h & 1) == 0 ? h : h + 1));
    REQUIRE(half_nearest_even(middle - step) == h);
    REQUIRE(half_nearest_even(middle + step) == h + 1);
    REQUIRE(half_toward_zero(hi - step) == h);
    REQUIRE(half_nearest_even(-middle - step) == (0x8000 | (h + 1)));
  }
}

TEST_CASE("overflow: 65520 is the first infinity; truncation stays at 65504") {
  CHECK(half_nearest_even(65519.999) == 0x7BFF);
  CHECK(half_nearest_even(65520) == 0x7C00);
  CHECK(half_nearest_even(-1e30) == 0xFC00);
  CHECK(half_toward_zero(65535.9) == 0x7BFF);
  CHECK(half_toward_zero(-1e30) == 0xFBFF);
  CHECK(half_to_double(0x0001) == 0x1p-24);
}
