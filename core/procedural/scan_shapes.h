// The forms behind the range images: fields in millimetres, the object's middle at x = y = 0, its support at z = 0, the sensor at +z.
#pragma once

#include "core/procedural/implicit.h"

namespace etalon::procedural {

/// Signed-distance-like; negative inside.
[[nodiscard]] double shuttle_field(const Vec3d& p);
[[nodiscard]] double hand_field(const Vec3d& p);
[[nodiscard]] double soldier_field(const Vec3d& p);
[[nodiscard]] double teapot_field(const Vec3d& p);
[[nodiscard]] double telephone_field(const Vec3d& p);

/// Distance to a box with rounded edges; `half` are its outer half sides, radius at most the least of them; exact.
[[nodiscard]] inline double rounded_box(const Vec3d& p, const Vec3d& center, const Vec3d& half, double radius) {
  const Vec3d q(std::fabs(p.x - center.x) - half.x + radius, std::fabs(p.y - center.y) - half.y + radius,
                std::fabs(p.z - center.z) - half.z + radius);
  const Vec3d outside(std::fmax(q.x, 0), std::fmax(q.y, 0), std::fmax(q.z, 0));
  return length(outside) + std::fmin(std::fmax(q.x, std::fmax(q.y, q.z)), 0) - radius;
}

/// Distance to a body of revolution of rectangular profile with rounded edges: at `from_axis` from its axis and `along` from its middle; exact.
[[nodiscard]] inline double rounded_disc(double from_axis, double along, double disc_radius, double half_height, double radius) {
  const double x = from_axis - disc_radius + radius, y = std::fabs(along) - half_height + radius;
  const double ox = std::fmax(x, 0), oy = std::fmax(y, 0);
  return std::sqrt(ox * ox + oy * oy) + std::fmin(std::fmax(x, y), 0) - radius;
}

[[nodiscard]] inline double length2(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace etalon::procedural
