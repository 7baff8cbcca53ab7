#include "core/procedural/noise.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/rng.h"

using namespace etalon;
using namespace etalon::procedural;

TEST_CASE("value noise is bounded, continuous over cell borders and takes its lattice values") {
  Rng rng(1);
  double least = 1, most = -1;
  for (int i = 0; i < 20000; ++i) {
    const Vec3d p(rng.unit() * 40 - 20, rng.unit() * 40 - 20, rng.unit() * 40 - 20);
    const double n = value_noise(p, 9);
    least = std::fmin(least, n);
    most = std::fmax(most, n);
  }
  CHECK(least >= -1);
  CHECK(most <= 1);
  CHECK(least < -0.8);
  CHECK(most > 0.8);
  for (int i = -3; i < 4; ++i) {
    const double x = i;
    // 2^-20 before a lattice plane the fade 1 − 10t³ + … lacks 10·2^-60, times a difference of at most 2; the rest is rounding of numbers
    // up to 1.
    CHECK(std::fabs(value_noise({x, 0.3, 0.7}, 2) - value_noise({x - 0x1p-20, 0.3, 0.7}, 2)) < 0x1p-50);
  }
  CHECK(value_noise({1, 2, 3}, 4) == 2 * (static_cast<double>(lattice_hash(1, 2, 3, 4) >> 11) * 0x1p-53) - 1);
  CHECK(value_noise({1, 2, 3}, 4) != value_noise({1, 2, 3}, 5));
}

TEST_CASE("cellular noise finds the two nearest of the jittered points") {
  Rng rng(2);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d p(rng.unit() * 10 - 5, rng.unit() * 10 - 5, rng.unit() * 10 - 5);
    const Cells cells = cellular_noise(p, 77);
    double best = 1e9, next = 1e9;
    for (int c = 0; c < 27; ++c) {
      const double x = std::floor(p.x) + c % 3 - 1, y = std::floor(p.y) + c / 3 % 3 - 1, z = std::floor(p.z) + c / 9 - 1;
      const std::uint64_t h = lattice_hash(static_cast<std::int64_t>(x), static_cast<std::int64_t>(y), static_cast<std::int64_t>(z), 77);
      const Vec3d d(x + static_cast<double>(h & 0xFFFFF) * 0x1p-20 - p.x, y + static_cast<double>((h >> 20) & 0xFFFFF) * 0x1p-20 - p.y,
                    z + static_cast<double>((h >> 40) & 0xFFFFF) * 0x1p-20 - p.z);
      const double distance = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
      if (distance < best)
        next = best, best = distance;
      else if (distance < next)
        next = distance;
    }
    REQUIRE(cells.nearest == best);
    REQUIRE(cells.second == next);
  }
}
