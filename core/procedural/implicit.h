// Implicit surfaces: primitives of signed distance, and what one does with a field: gradient, projection, first hit, occlusion.
// A field is negative inside; |field| never exceeds the distance by more than the caller's step factor allows for.
#pragma once

#include "core/procedural/smooth_math.h"

namespace etalon::procedural {

using Field = double (*)(const Vec3d&);

/// Distance to the hull of two balls (a, radius_a) and (b, radius_b), neither inside the other; exact [Quilez, "round cone"].
[[nodiscard]] inline double round_cone(const Vec3d& p, const Vec3d& a, const Vec3d& b, double radius_a, double radius_b) {
  const Vec3d ba = b - a, pa = p - a;
  const double l2 = dot(ba, ba), rr = radius_a - radius_b;
  const double a2 = l2 - rr * rr, il2 = 1 / l2;
  const double y = dot(pa, ba), z = y - l2;
  const Vec3d side = pa * l2 - ba * y;
  const double x2 = dot(side, side), y2 = y * y * l2, z2 = z * z * l2;
  const double k = (rr < 0 ? -rr : rr) * rr * x2;
  if ((z < 0 ? -1 : 1) * a2 * z2 > k) return std::sqrt(x2 + z2) * il2 - radius_b;
  if ((y < 0 ? -1 : 1) * a2 * y2 < k) return std::sqrt(x2 + y2) * il2 - radius_a;
  return (std::sqrt(x2 * a2 * il2) + y * rr) * il2 - radius_a;
}

/// First-order distance to an axis-aligned ellipsoid; its zero set is exact.
[[nodiscard]] inline double ellipsoid(const Vec3d& p, const Vec3d& center, const Vec3d& radii) {
  const Vec3d q = (p - center) / radii;
  const Vec3d g = q / radii;
  const double k0 = length(q), k1 = length(g);
  if (!(k1 > 0)) return -std::fmin(radii.x, std::fmin(radii.y, radii.z));
  return k0 * (k0 - 1) / k1;
}

/// Unit gradient by four differences at distance h (the corners of a tetrahedron).
[[nodiscard]] Vec3d field_normal(Field field, const Vec3d& p, double h);

/// p moved along the gradient to the zero set: `steps` damped Newton steps. Keeps x = 0 only up to rounding.
[[nodiscard]] Vec3d projected(Field field, Vec3d p, int steps);

/// The outermost zero on the ray origin + s·direction, s in [0, reach]: marches inward from s = reach; 0 where the ray meets nothing.
[[nodiscard]] double outermost_hit(Field field, const Vec3d& origin, const Vec3d& direction, double reach);

/// Share of the hemisphere above a surface point that is open sky, in [0, 1], each ray weighted by its cosine and by how near it passes
/// to the surface.
[[nodiscard]] double sky_visibility(Field field, const Vec3d& p, const Vec3d& normal, int ray_count, double reach);

/// Softened visibility of a distant light, in [0, 1]; `softness` is the light's half-angle as a tangent.
[[nodiscard]] double light_visibility(Field field, const Vec3d& p, const Vec3d& normal, const Vec3d& to_light, double softness,
                                      double reach);

}  // namespace etalon::procedural
