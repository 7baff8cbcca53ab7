#include "core/procedural/implicit.h"

#include <cmath>

namespace etalon::procedural {

namespace {

/// March of a ray that has left the surface: the least clearance/(softness·distance) met, 1 where it never comes near.
double clearance(Field field, const Vec3d& start, const Vec3d& direction, double softness, double reach) {
  double open = 1;
  double s = 0.03;
  while (s < reach) {
    const double d = field(start + direction * s);
    const double ratio = 0.5 + 0.5 * d / (softness * s);
    if (ratio <= 0) return 0;
    if (ratio < open) open = ratio;
    s += std::fmax(0.7 * d, 0.04);
  }
  return open * open * (3 - 2 * open);
}

}  // namespace

Vec3d field_normal(Field field, const Vec3d& p, double h) {
  const Vec3d a(1, -1, -1), b(-1, -1, 1), c(-1, 1, -1), d(1, 1, 1);
  const double fa = field(p + a * h), fb = field(p + b * h), fc = field(p + c * h), fd = field(p + d * h);
  return normalized(a * fa + b * fb + c * fc + d * fd);
}

Vec3d projected(Field field, Vec3d p, int steps) {
  for (int i = 0; i < steps; ++i) p -= field_normal(field, p, 1e-4) * (0.9 * field(p));
  return p;
}

double outermost_hit(Field field, const Vec3d& origin, const Vec3d& direction, double reach) {
  double s = reach, outside = reach;
  for (int i = 0; i < 200 && s > 0; ++i) {
    const double d = field(origin + direction * s);
    if (d < 0) break;
    outside = s;
    s -= std::fmax(0.6 * d, 1e-3);
  }
  if (s <= 0) return 0;
  double inside = s;
  for (int i = 0; i < 26; ++i) {
    const double middle = 0.5 * (inside + outside);
    (field(origin + direction * middle) < 0 ? inside : outside) = middle;
  }
  return 0.5 * (inside + outside);
}

double sky_visibility(Field field, const Vec3d& p, const Vec3d& normal, int ray_count, double reach) {
  const Vec3d tangent = normalized(cross(normal, std::fabs(normal.y) < 0.8 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0)));
  const Vec3d bitangent = cross(normal, tangent);
  const Vec3d start = p + normal * 0.01;
  double sum = 0;
  for (int i = 0; i < ray_count; ++i) {
    // A spiral over the disc, lifted to the hemisphere: cosine-distributed [Malley], turned by the golden ratio from ray to ray.
    const double r2 = (i + 0.5) / ray_count, r = std::sqrt(r2), turn = i * 0.61803398874989485;
    const Vec3d direction = tangent * (r * cos_turns(turn)) + bitangent * (r * sin_turns(turn)) + normal * std::sqrt(1 - r2);
    sum += clearance(field, start, direction, 0.25, reach);
  }
  return sum / ray_count;
}

double light_visibility(Field field, const Vec3d& p, const Vec3d& normal, const Vec3d& to_light, double softness, double reach) {
  return clearance(field, p + normal * 0.01, to_light, softness, reach);
}

}  // namespace etalon::procedural
