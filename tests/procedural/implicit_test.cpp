#include "core/procedural/implicit.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace etalon;
using namespace etalon::procedural;

namespace {

double unit_ball(const Vec3d& p) { return length(p) - 1; }
double cup(const Vec3d& p) { return smooth_max(unit_ball(p), -(length(p - Vec3d(0, 1, 0)) - 0.7), 0.05); }

}  // namespace

TEST_CASE("primitives of distance") {
  const Vec3d a(0, 0, 0), b(4, 0, 0);
  CHECK(round_cone({2, 5, 0}, a, b, 1, 1) == doctest::Approx(4).epsilon(1e-14));
  CHECK(round_cone({-3, 0, 0}, a, b, 1, 2) == doctest::Approx(2).epsilon(1e-14));
  CHECK(round_cone({9, 0, 0}, a, b, 1, 2) == doctest::Approx(3).epsilon(1e-14));
  CHECK(ellipsoid({1, 2, 3}, {1, 2, 0}, {1, 1, 3}) == 0);
  CHECK(ellipsoid({1, 2, 0}, {1, 2, 0}, {1, 2, 3}) == -1);
  CHECK(ellipsoid({9, 2, 0}, {1, 2, 0}, {4, 2, 3}) > 0);
}

TEST_CASE("normal, projection and hit on a ball") {
  const Vec3d p = normalized(Vec3d(1, 2, -3));
  CHECK(dot(field_normal(unit_ball, p, 1e-4), p) > 1 - 1e-7);             // differences at distance h err by O(h²)
  CHECK(std::fabs(length(projected(unit_ball, p * 1.2, 8)) - 1) < 1e-8);  // each step leaves a tenth: 0.2·10^-8
  const double hit = outermost_hit(unit_ball, {0, 0, 0.5}, {0, 0, 1}, 4);
  CHECK(std::fabs(hit - 0.5) < 1e-8);  // steps of 0.6·distance stop short; the step of 1e-3 that enters is halved 26 times
  CHECK(outermost_hit(unit_ball, {0, 5, 0}, {0, 0, 1}, 4) == 0);
}

TEST_CASE("sky and light: all from a ball, less from the bottom of a cup") {
  CHECK(sky_visibility(unit_ball, {0, 1, 0}, {0, 1, 0}, 32, 3) > 0.9);
  const double open = sky_visibility(cup, {0, 0.3, 0}, {0, 1, 0}, 32, 3);
  CHECK(open > 0.05);
  CHECK(open < 0.8);
  CHECK(light_visibility(unit_ball, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}, 0.2, 3) == 1);
  CHECK(light_visibility(unit_ball, {0, 1, 0}, {0, 1, 0}, {0, -1, 0}, 0.2, 3) == 0);
}
