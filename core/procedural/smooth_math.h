// Smooth scalar functions from + − × ÷ √ and floor alone, in a written order: the same double on every compiler and C library.
// Angles are in turns (1 = 360°), because the reduction of a turn to one period is exact.
#pragma once

#include <cmath>

#include "core/math/vec.h"

namespace etalon::procedural {

inline constexpr double kPi = 3.14159265358979323846;

/// sin(2π·turns), |error| <= 4e-16 + 2π·2^-53·|turns| for |turns| < 2^50: Taylor's series to the 19th power on a quarter turn
/// (remainder (π/2)^21/21! < 3e-16).
[[nodiscard]] double sin_turns(double turns);
/// cos(2π·turns), as sin_turns.
[[nodiscard]] double cos_turns(double turns);

[[nodiscard]] constexpr double clamp01(double x) { return x < 0 ? 0 : (x > 1 ? 1 : x); }
[[nodiscard]] constexpr double mix(double a, double b, double t) { return a + (b - a) * t; }
[[nodiscard]] inline Vec3d mix(const Vec3d& a, const Vec3d& b, double t) { return a + (b - a) * t; }

/// 0 up to `from`, 1 from `to` on, the cubic 3t² − 2t³ between; from > to gives the falling step.
[[nodiscard]] constexpr double smooth_step(double from, double to, double x) {
  const double t = clamp01((x - from) / (to - from));
  return t * t * (3 - 2 * t);
}

/// (1 − (x/radius)²)², 0 outside: a bell of value 1 at 0 with a continuous derivative.
[[nodiscard]] constexpr double bump(double x, double radius) {
  const double s = 1 - (x / radius) * (x / radius);
  return s > 0 ? s * s : 0;
}

/// min(a, b) rounded by a parabola where |a − b| < k, k > 0; never above min(a, b), below it by at most k/4 [Quilez, "smooth minimum"].
[[nodiscard]] constexpr double smooth_min(double a, double b, double k) {
  const double d = a > b ? a - b : b - a;
  const double h = k - d > 0 ? (k - d) / k : 0;
  return (a < b ? a : b) - h * h * k * 0.25;
}
[[nodiscard]] constexpr double smooth_max(double a, double b, double k) { return -smooth_min(-a, -b, k); }

[[nodiscard]] inline double dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] inline Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline double length(const Vec3d& a) { return std::sqrt(dot(a, a)); }
/// a / |a|; the zero vector becomes (0, 1, 0).
[[nodiscard]] inline Vec3d normalized(const Vec3d& a) {
  const double l = length(a);
  if (!(l > 0)) return {0, 1, 0};
  return {a.x / l, a.y / l, a.z / l};
}

}  // namespace etalon::procedural
