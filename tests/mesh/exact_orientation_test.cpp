#include "core/mesh/exact_orientation.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/base/rng.h"

using namespace etalon;

namespace {

/// Sign by integers, for coordinates that are integers below 2^24.
int integer_orientation(const std::int64_t (&p)[6]) {
  const std::int64_t area = (p[2] - p[0]) * (p[5] - p[1]) - (p[3] - p[1]) * (p[4] - p[0]);
  return area > 0 ? 1 : (area < 0 ? -1 : 0);
}

}  // namespace

TEST_CASE("orientation: turns and lines") {
  CHECK(orientation({0, 0}, {1, 0}, {0, 1}) == 1);
  CHECK(orientation({0, 0}, {0, 1}, {1, 0}) == -1);
  CHECK(orientation({0, 0}, {1, 1}, {2, 2}) == 0);
  CHECK(orientation({3, 4}, {3, 4}, {5, 6}) == 0);
}

TEST_CASE("orientation equals integer arithmetic, near lines above all") {
  Rng rng(7);
  int zeros = 0;
  for (int i = 0; i < 20000; ++i) {
    std::int64_t p[6];
    for (auto& x : p) x = rng.between(-(1 << 24), 1 << 24);
    if (i % 2 == 0) {  // a point nearly or exactly on the line through the other two
      const std::int64_t dx = rng.between(-2000, 2000), dy = rng.between(-2000, 2000), m = rng.between(-2000, 2000),
                         n = rng.between(-2000, 2000);
      p[0] = rng.between(-1000, 1000), p[1] = rng.between(-1000, 1000);
      p[2] = p[0] + m * dx, p[3] = p[1] + m * dy, p[4] = p[0] + n * dx + rng.between(-1, 1), p[5] = p[1] + n * dy;
    }
    const auto f = [&](int k) { return static_cast<float>(p[k]); };
    const int expected = integer_orientation(p);
    zeros += expected == 0;
    REQUIRE(orientation({f(0), f(1)}, {f(2), f(3)}, {f(4), f(5)}) == expected);
  }
  CHECK(zeros > 1000);
}

TEST_CASE("orientation is exact where double arithmetic is not") {
  // Differences of these floats need 173 bits: the doubled area is 2^-149·2^127, far below an ulp of the products' sum in double.
  const float huge = 0x1p127f, tiny = std::numeric_limits<float>::denorm_min();
  CHECK(orientation({-huge, -huge}, {huge, huge}, {0, tiny}) == 1);
  CHECK(orientation({-huge, -huge}, {huge, huge}, {0, -tiny}) == -1);
  CHECK(orientation({-huge, -huge}, {huge, huge}, {0, 0}) == 0);
  CHECK(orientation({0, 0}, {tiny, 0}, {0, tiny}) == 1);
  // The same question asked of double: the differences round and the answer is lost.
  CHECK(doubled_area({-huge, -huge}, {huge, huge}, {0, tiny}) == 0);
}

TEST_CASE("orientation: swapping two corners turns the sign, turning the corners keeps it") {
  Rng rng(11);
  for (int i = 0; i < 5000; ++i) {
    Vec2f p[3];
    for (auto& q : p)
      q = {std::ldexp(rng.uniform(-1, 1), static_cast<int>(rng.between(-60, 60))),
           std::ldexp(rng.uniform(-1, 1), static_cast<int>(rng.between(-60, 60)))};
    const int s = orientation(p[0], p[1], p[2]);
    REQUIRE(orientation(p[1], p[2], p[0]) == s);
    REQUIRE(orientation(p[1], p[0], p[2]) == -s);
  }
}

TEST_CASE("is_collinear") {
  CHECK(is_collinear({0, 0, 0}, {1, 2, 3}, {2, 4, 6}));
  CHECK(is_collinear({1, 1, 1}, {1, 1, 1}, {5, 6, 7}));
  CHECK_FALSE(is_collinear({0, 0, 0}, {1, 2, 3}, {2, 4, 6.0000005f}));
  CHECK_FALSE(is_collinear({0, 0, 0}, {0, 0, 1}, {0, 1, 0}));
}
