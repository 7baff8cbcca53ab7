#include "validation/metrics/decibel.h"

#include <cmath>

#include <doctest/doctest.h>

#include "core/base/rng.h"

using namespace etalon;
using namespace etalon::validation;

TEST_CASE("decibel of powers of ten and two") {
  CHECK(decibel(1.0) == 0.0);
  CHECK(std::fabs(decibel(10.0) - 10.0) < 1e-12);
  CHECK(std::fabs(decibel(1000.0) - 30.0) < 1e-12);
  CHECK(std::fabs(decibel(0.001) + 30.0) < 1e-12);
  CHECK(std::fabs(decibel(2.0) - 3.010299956639812) < 1e-12);
}

TEST_CASE("decibel agrees with the platform's log10 over the whole range") {
  Rng rng(7);
  for (int i = 0; i < 100000; ++i) {
    const double x = std::ldexp(1.0 + rng.unit(), static_cast<int>(rng.between(-1000, 1000)));
    const double expected = 10.0 * std::log10(x);
    // The promise of the header: 1e-12 dB + 4 ulp; the platform's own log10 is within 1 ulp.
    REQUIRE(std::fabs(decibel(x) - expected) <= 1e-12 + 5 * 0x1p-52 * std::fabs(expected));
  }
}

TEST_CASE("PSNR: known value, and nothing where there is nothing to say") {
  // One 8-bit sample of 100 off by 5: 10·log10(255²·100/25) = 54.1514 dB.
  REQUIRE(psnr_db(25, 100, 255).has_value());
  CHECK(*psnr_db(25, 100, 255) == 54.1514);
  CHECK(!psnr_db(0, 100, 255).has_value());
  CHECK(!psnr_db(25, 0, 255).has_value());
}
