#include "core/procedural/smooth_math.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/rng.h"

using namespace etalon;
using namespace etalon::procedural;

TEST_CASE("sine and cosine of turns stay within their stated error") {
  Rng rng(5);
  for (int i = 0; i < 100000; ++i) {
    const double turns = rng.unit() * 8 - 4;
    // The bound of the header, and glibc's own half ulp in long double is far below it.
    const double bound = 4e-16 + 2 * kPi * 0x1p-53 * std::fabs(turns);
    REQUIRE(std::fabs(sin_turns(turns) - static_cast<double>(std::sin(2 * 3.14159265358979323846264338328L * turns))) <= bound);
    REQUIRE(std::fabs(cos_turns(turns) - static_cast<double>(std::cos(2 * 3.14159265358979323846264338328L * turns))) <=
            bound + 2 * kPi * 0x1p-53);
  }
  CHECK(sin_turns(0) == 0);
  CHECK(sin_turns(0.5) == 0);
  CHECK(sin_turns(7) == 0);
  CHECK(cos_turns(0.25) == 0);
  CHECK(cos_turns(0) == doctest::Approx(1).epsilon(4e-16));
  CHECK(sin_turns(-0.125) == -sin_turns(0.125));
}

TEST_CASE("steps, bells and smooth minimum") {
  CHECK(smooth_step(1, 3, 1) == 0);
  CHECK(smooth_step(1, 3, 2) == 0.5);
  CHECK(smooth_step(1, 3, 4) == 1);
  CHECK(smooth_step(3, 1, 4) == 0);
  CHECK(smooth_step(3, 1, 0) == 1);
  CHECK(bump(0, 2) == 1);
  CHECK(bump(2, 2) == 0);
  CHECK(bump(-3, 2) == 0);
  CHECK(smooth_min(1, 5, 1) == 1);
  CHECK(smooth_min(1, 1, 1) == 0.75);
  CHECK(smooth_max(1, 1, 1) == 1.25);
  CHECK(smooth_min(1, 1.25, 1) < 1);
}
