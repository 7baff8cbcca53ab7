// Where two edges cross, in a plane or, as nearest points, in space [Chen & Chuang 2006, sec. 3.2, the 2 × 2 system].
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/math/nearest_point.h"

namespace etalon::adapt {

/// Parameters along the first and along the second edge.
struct CrossingParameters {
  double first = 0.5, second = 0.5;
};

namespace detail {
inline double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }
}  // namespace detail

/// Of the lines a0–a1 and b0–b1, brought into [0, 1]; the middles where they are parallel.
inline CrossingParameters crossing_in_plane(const Vec2d& a0, const Vec2d& a1, const Vec2d& b0, const Vec2d& b1) {
  const Vec2d a = a1 - a0, b = b1 - b0;
  const double area = detail::cross(a, b);
  if (area == 0) return {0.5, 0.5};
  return {std::clamp(detail::cross(b0 - a0, b) / area, 0.0, 1.0), std::clamp(detail::cross(b0 - a0, a) / area, 0.0, 1.0)};
}

/// The nearest points of the lines a0–a1 and b0–b1; nothing where these are parallel (a squared sine below 2^-40) or one is not strictly between
/// the ends.
inline std::optional<CrossingParameters> nearest_in_space(const Vec3f& a0, const Vec3f& a1, const Vec3f& b0, const Vec3f& b1) {
  const Vec3d a = difference_of(a0, a1), b = difference_of(b0, b1), ab = difference_of(a0, b0);
  const double aa = dot_product(a, a), bb = dot_product(b, b), a_b = dot_product(a, b);
  const double right_a = dot_product(ab, a), right_b = dot_product(ab, b), determinant = a_b * a_b - aa * bb;
  if (!(std::abs(determinant) > 0x1p-40 * aa * bb)) return std::nullopt;
  const CrossingParameters at{(a_b * right_b - bb * right_a) / determinant, (aa * right_b - a_b * right_a) / determinant};
  if (!(at.first > 0 && at.first < 1 && at.second > 0 && at.second < 1)) return std::nullopt;
  return at;
}

}  // namespace etalon::adapt
