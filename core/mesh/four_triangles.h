// Lower bounds of the distances of a point to four triangles at once, in float.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/math/vec.h"

namespace etalon {

// Four numbers side by side: plain IEEE operations on each, on every machine.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

inline Float4 all_four(float x) { return Float4{x, x, x, x}; }
inline Float4 larger(Float4 a, Float4 b) { return a > b ? a : b; }
inline Float4 smaller(Float4 a, Float4 b) { return a < b ? a : b; }

/// A point in units in which the triangles' coordinates are at most 1 in absolute value.
struct ScaledPoint {
  Float4 at[3];
  Float4 slack;  ///< 2^-22 of the largest coordinate there is: of rounding p, the triangles, and what is computed of them

  explicit ScaledPoint(const Vec3d& p)
      : at{all_four(static_cast<float>(p.x)), all_four(static_cast<float>(p.y)), all_four(static_cast<float>(p.z))},
        slack(all_four(static_cast<float>(std::max({1.0, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) * 0x1p-22))) {}
};

/// For orthonormal u and m, |p − q|² ≥ (u·(p − q))² + (m·(p − q))²: the distance of p to a triangle is at least the root of the sum of squares of how far p
/// lies outside the triangle's extents along u and along m. u is near its normal, m one of the three directions away from an edge; above
/// the face and in the regions of its edges the bound is nearly the distance.
///
/// The bound holds for any u and m. Their lengths and right angle are off by less than 2^-17, which normalize() verifies (else the vector is zero, and with it
/// the bound), so the sum of squares is too large by less than 2^-15 of itself. Corners and point have coordinates of at most M = max(1, |p|): a
/// dot product is off by 3·2^-24·√3·M and, for its rounded arguments, √3·2^-24·M; an extent's end and a product together by less than
/// 14·2^-24·M, and their difference by √3·2^-23·M: in all less than 18·2^-24·M < 2^-19·M, which is taken off.
struct FourTriangles {
  Float4 u[3], lo, hi;
  Float4 m[3][3], top[3];

  FourTriangles() = default;
  /// corner[c][k]: coordinate k of corner c of the four.
  explicit FourTriangles(const Float4 (&corner)[3][3]) {
    Float4 side[3][3];
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) side[c][k] = corner[(c + 1) % 3][k] - corner[c][k];
    const Float4 none[3] = {all_four(0), all_four(0), all_four(0)};
    cross(side[0], side[1], u);
    normalize(u, none);
    const Float4 along[3] = {dot(u, corner[0]), dot(u, corner[1]), dot(u, corner[2])};
    lo = smaller(along[0], smaller(along[1], along[2]));
    hi = larger(along[0], larger(along[1], along[2]));
    for (int c = 0; c < 3; ++c) {
      cross(side[c], u, m[c]);
      normalize(m[c], u);
      top[c] = larger(dot(m[c], corner[0]), larger(dot(m[c], corner[1]), dot(m[c], corner[2])));
    }
  }

  /// Not above what nearest_on_triangle() gives by more than 2^-14 of itself.
  [[nodiscard]] Float4 distance2(const ScaledPoint& p) const {
    const Float4 along = dot(u, p.at), zero = all_four(0), slack = p.slack * 8;
    const Float4 off = larger(larger(lo - along, along - hi) - slack, zero);
    const Float4 outside = larger(larger(dot(m[0], p.at) - top[0], dot(m[1], p.at) - top[1]), dot(m[2], p.at) - top[2]);
    const Float4 away = larger(outside - slack, zero);
    return off * off + away * away;
  }

 private:
  static Float4 dot(const Float4 (&a)[3], const Float4 (&b)[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static void cross(const Float4 (&a)[3], const Float4 (&b)[3], Float4 (&result)[3]) {
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      result[k] = a[i] * b[j] - a[j] * b[i];
    }
  }
  /// a of about unit length; zero where it is not, or where it is not at right angles to `to`. Scaled by its largest coordinate first, so that
  /// squares of small ones do not vanish.
  static void normalize(Float4 (&a)[3], const Float4 (&to)[3]) {
    const auto size = [](Float4 x) { return larger(x, -x); };
    const Float4 largest = larger(size(a[0]), larger(size(a[1]), size(a[2])));
    for (Float4& x : a) x /= largest;
    Float4 length = dot(a, a);
    for (std::size_t i = 0; i < 4; ++i) length[i] = std::sqrt(length[i]);
    for (Float4& x : a) x /= length;
    const Float4 off = size(dot(a, a) - 1), across = size(dot(a, to)), most = all_four(0x1p-18f), zero = all_four(0);
    for (Float4& x : a) x = off < most ? (across < most ? x : zero) : zero;  // what is no number is not less
  }
};

}  // namespace etalon
