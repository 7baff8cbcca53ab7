// Nearest points of segments and triangles, in double, in a written order: the same bits everywhere.
#pragma once

#include <initializer_list>

#include "core/math/vec.h"

namespace etalon {

inline Vec3d to_double(const Vec3f& p) { return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)}; }
/// to − from, of float32 points: in double, so that near points lose nothing.
inline Vec3d difference_of(const Vec3f& from, const Vec3f& to) {
  return {static_cast<double>(to.x) - from.x, static_cast<double>(to.y) - from.y, static_cast<double>(to.z) - from.z};
}
inline double dot_product(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3d cross_product(const Vec3d& a, const Vec3d& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double squared_distance(const Vec3d& a, const Vec3d& b) {
  const Vec3d d{a.x - b.x, a.y - b.y, a.z - b.z};
  return dot_product(d, d);
}

/// A point of a triangle (a, b, c): its weights, each in [0, 1], their sum 1 up to rounding, and where it is.
struct NearestOnTriangle {
  Vec3d weights{1, 0, 0};
  Vec3d point{0, 0, 0};
  double distance2 = 0;  ///< squared distance from the query to `point`
};

/// The parameter t in [0, 1] of the point a + t(b − a) nearest to p; 0 where a = b.
inline double nearest_on_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d ab{b.x - a.x, b.y - a.y, b.z - a.z}, ap{p.x - a.x, p.y - a.y, p.z - a.z};
  const double along = dot_product(ab, ap), length2 = dot_product(ab, ab);
  if (!(along > 0) || !(length2 > 0)) return 0;
  return along < length2 ? along / length2 : 1;
}

namespace detail {

inline NearestOnTriangle at_weights(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& w) {
  // From a along the sides: what all corners have in common stays exact.
  const Vec3d q{a.x + (w.y * (b.x - a.x) + w.z * (c.x - a.x)), a.y + (w.y * (b.y - a.y) + w.z * (c.y - a.y)),
                a.z + (w.y * (b.z - a.z) + w.z * (c.z - a.z))};
  return {w, q, squared_distance(p, q)};
}

inline NearestOnTriangle nearest_on_border(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double t = nearest_on_segment(p, a, b), u = nearest_on_segment(p, b, c), v = nearest_on_segment(p, c, a);
  NearestOnTriangle best = at_weights(p, a, b, c, {1 - t, t, 0});
  for (const NearestOnTriangle& other : {at_weights(p, a, b, c, {0, 1 - u, u}), at_weights(p, a, b, c, {v, 0, 1 - v})})
    if (other.distance2 < best.distance2) best = other;
  return best;
}

}  // namespace detail

/// The point of the triangle nearest to p, by Voronoi regions [Ericson 2005, sec. 5.1.5]. Triangles of any shape: one whose height is below
/// 2^-24 of its longest edges' lengths (the rounding of float32 corners) is treated as its three edges. `point` is within 4 ulp of the largest
/// coordinate of the triangle's plane piece, whatever its shape, since the weights lie in [0, 1]; so distance2 never falls below the true
/// squared distance by more than that. The distance exceeds the true one by at most 2^-24 of the longest edge for p as near as that, and for
/// triangles of heights above 2^-12 of it by 2^-38 (tests/math/nearest_point_test.cpp). Overflows beyond coordinates of 2^250.
inline NearestOnTriangle nearest_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d ab{b.x - a.x, b.y - a.y, b.z - a.z}, ac{c.x - a.x, c.y - a.y, c.z - a.z};
  const Vec3d ap{p.x - a.x, p.y - a.y, p.z - a.z};
  const double d1 = dot_product(ab, ap), d2 = dot_product(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {{1, 0, 0}, a, squared_distance(p, a)};
  const Vec3d bp{p.x - b.x, p.y - b.y, p.z - b.z};
  const double d3 = dot_product(ab, bp), d4 = dot_product(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {{0, 1, 0}, b, squared_distance(p, b)};
  const Vec3d cp{p.x - c.x, p.y - c.y, p.z - c.z};
  const double d5 = dot_product(ab, cp), d6 = dot_product(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {{0, 0, 1}, c, squared_distance(p, c)};
  // Weights as areas seen along the normal, each from a corner that is its own: their errors are 2^-50·|ap|·L / |n|, where the usual products of d1 to d6
  // would have another factor L² / |n|, which for slivers is all there is.
  const Vec3d n = cross_product(ab, ac), bc{c.x - b.x, c.y - b.y, c.z - b.z};
  const double va = dot_product(n, cross_product(bc, bp)), vb = dot_product(n, cross_product(ap, ac)),
               vc = dot_product(n, cross_product(ab, ap));
  const double doubled_area2 = va + vb + vc;
  // |ab × ac|² against |ab|²|ac|²: the squared sine at a.
  if (!(va > 0 && vb > 0 && vc > 0) || !(doubled_area2 > 0x1p-48 * (dot_product(ab, ab) * dot_product(ac, ac))))
    return detail::nearest_on_border(p, a, b, c);
  const double v = vb / doubled_area2, w = vc / doubled_area2;
  return detail::at_weights(p, a, b, c, {1 - v - w, v, w});
}

}  // namespace etalon
