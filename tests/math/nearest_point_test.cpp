#include "core/math/nearest_point.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "core/base/rng.h"

using namespace etalon;

namespace {

using Rational = boost::multiprecision::cpp_rational;
using Exact = std::array<Rational, 3>;

Exact exact(const Vec3d& p) { return {Rational(p.x), Rational(p.y), Rational(p.z)}; }
Exact minus(const Exact& a, const Exact& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Rational dot(const Exact& a, const Exact& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Rational to_segment(const Exact& p, const Exact& a, const Exact& b) {
  const Exact ab = minus(b, a), ap = minus(p, a);
  const Rational length2 = dot(ab, ab);
  Rational t = length2 == 0 ? Rational(0) : Rational(dot(ab, ap) / length2);
  t = std::clamp(t, Rational(0), Rational(1));
  const Exact d{ap[0] - t * ab[0], ap[1] - t * ab[1], ap[2] - t * ab[2]};
  return dot(d, d);
}

/// The exact squared distance: to the plane where the foot is inside, else to the nearest edge.
Rational to_triangle(const Exact& p, const Exact& a, const Exact& b, const Exact& c) {
  Rational best = std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
  const Exact ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
  const Exact n{ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2], ab[0] * ac[1] - ab[1] * ac[0]};
  const Rational n2 = dot(n, n);
  if (n2 == 0) return best;
  const auto side = [&](const Exact& from, const Exact& to) {
    const Exact e = minus(to, from), q = minus(p, from);
    return dot({e[1] * q[2] - e[2] * q[1], e[2] * q[0] - e[0] * q[2], e[0] * q[1] - e[1] * q[0]}, n);
  };
  if (side(a, b) < 0 || side(b, c) < 0 || side(c, a) < 0) return best;
  const Rational height = dot(ap, n);
  return height * height / n2;
}

}  // namespace

TEST_CASE("each region of a triangle") {
  const Vec3d a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
  const auto at = [&](const Vec3d& p) { return nearest_on_triangle(p, a, b, c); };
  CHECK(at({-1, -2, 2}).point == a);
  CHECK(at({-1, -2, 2}).distance2 == 9);
  CHECK(at({6, -1, 0}).point == b);
  CHECK(at({-1, 7, 0}).point == c);
  CHECK(at({1, -3, 4}).point == Vec3d(1, 0, 0));
  CHECK(at({1, -3, 4}).distance2 == 25);
  CHECK(at({-2, 3, 0}).point == Vec3d(0, 3, 0));
  CHECK(at({3, 3, 1}).point == Vec3d(2, 2, 0));
  CHECK(at({3, 3, 1}).weights == Vec3d(0, 0.5, 0.5));
  CHECK(at({1, 1, -3}).point == Vec3d(1, 1, 0));
  CHECK(at({1, 1, -3}).weights == Vec3d(0.5, 0.25, 0.25));
  CHECK(at({1, 1, -3}).distance2 == 9);
}

TEST_CASE("segments: inside, beyond either end, of no length") {
  CHECK(nearest_on_segment({1, 5, 0}, {0, 0, 0}, {4, 0, 0}) == 0.25);
  CHECK(nearest_on_segment({-1, 5, 0}, {0, 0, 0}, {4, 0, 0}) == 0);
  CHECK(nearest_on_segment({9, 5, 0}, {0, 0, 0}, {4, 0, 0}) == 1);
  CHECK(nearest_on_segment({9, 5, 0}, {2, 2, 2}, {2, 2, 2}) == 0);
}

TEST_CASE("triangles without area are their edges") {
  const Vec3d a{0, 0, 0}, b{2, 0, 0}, c{6, 0, 0};
  CHECK(nearest_on_triangle({4, 3, 0}, a, b, c).point == Vec3d(4, 0, 0));
  CHECK(nearest_on_triangle({4, 3, 0}, c, a, b).distance2 == 9);
  CHECK(nearest_on_triangle({1, 2, 2}, a, a, a).distance2 == 9);
  CHECK(nearest_on_triangle({7, 0, 0}, a, c, c).point == c);
}

// Coordinates are integers below 2^10, so products are exact and `point` is off by a few ulp of 2^10, below 2^-40; the squared distance,
// of a distance below 2^12, by less than 2·2^12·2^-40 = 2^-27.
TEST_CASE("against exact rationals") {
  Rng rng(3);
  const auto point = [&](std::int64_t size) {
    Vec3d p;
    for (int k = 0; k < 3; ++k) p[k] = static_cast<double>(rng.between(-size, size));
    return p;
  };
  for (int i = 0; i < 4000; ++i) {
    const std::int64_t size = i % 2 == 0 ? 3 : 1000;  // small ones are often degenerate, right-angled, or hit a border exactly
    const Vec3d a = point(size), b = point(size), c = point(size), p = point(size);
    const NearestOnTriangle found = nearest_on_triangle(p, a, b, c);
    const Rational truth = to_triangle(exact(p), exact(a), exact(b), exact(c));
    CAPTURE(i);
    REQUIRE(boost::multiprecision::abs(Rational(Rational(found.distance2) - truth)) < Rational(0x1p-27));
    REQUIRE(std::min({found.weights.x, found.weights.y, found.weights.z}) >= -0x1p-52);
    REQUIRE(std::max({found.weights.x, found.weights.y, found.weights.z}) <= 1);
    REQUIRE(squared_distance(p, found.point) == found.distance2);
  }
}

// What is derived in nearest_point.h: a height below 2^-24 of the longest edge L ignores the face, which costs less than that; else weights, and with
// them the place along the longest edge, are off by 2^-50·L²/|n|: 2^-26·L at that height, 2^-38·L at heights of 2^-12·L.
TEST_CASE("slivers: the distance is hardly above the exact one, and not below") {
  Rng rng(4);
  const auto number = [&] { return static_cast<double>(static_cast<float>(2 * rng.unit() - 1)); };
  const auto point = [&] {
    Vec3d p;
    for (int k = 0; k < 3; ++k) p[k] = number();
    return p;
  };
  for (int i = 0; i < 6000; ++i) {
    const double height = std::ldexp(1.0, -static_cast<int>(rng.below(30))), away = std::ldexp(1.0, -static_cast<int>(rng.below(30)));
    const Vec3d a = point(), b = point();
    const Vec3d c(Vec3f(a + (b - a) * number() + point() * height));
    const double u = rng.unit(), v = (1 - u) * rng.unit();
    const Vec3d p = a + (b - a) * u + (c - a) * v + point() * away;
    const double found = std::sqrt(nearest_on_triangle(p, a, b, c).distance2);
    const double truth = std::sqrt(static_cast<double>(to_triangle(exact(p), exact(a), exact(b), exact(c))));
    const double longest2 = std::max({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)}),
                 longest = std::sqrt(longest2);
    const Vec3d n = cross_product(b - a, c - a);
    const bool is_high = dot_product(n, n) > 0x1p-24 * longest2 * longest2;
    CAPTURE(i);
    REQUIRE(found >= truth * (1 - 0x1p-50) - 0x1p-50);  // 4 ulp of coordinates below 4
    REQUIRE(found <= truth * (1 + 0x1p-50) + (is_high ? 0x1p-38 : 0x1p-24) * longest);
  }
}
