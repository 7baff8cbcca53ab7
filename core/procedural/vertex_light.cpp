#include "core/procedural/vertex_light.h"

#include <cmath>

namespace etalon::procedural {

namespace {

double openness(Field field, const Vec3d& p, const Vec3d& normal, double size) {
  double taken = 0, weight = 1;
  for (int i = 1; i <= 5; ++i) {
    const double h = size * 0.012 * i * i;
    taken += weight * std::fmax(0, h - field(p + normal * h)) / h;
    weight *= 0.8;
  }
  return clamp01(1 - 0.42 * taken);
}

double key_visibility(Field field, const Vec3d& p, const Vec3d& normal, const Vec3d& to_key, double size) {
  double open = 1, s = 0.02 * size;
  const Vec3d start = p + normal * (0.01 * size);
  for (int i = 0; i < 24 && s < 1.5 * size; ++i) {
    const double d = field(start + to_key * s), ratio = 0.5 + 0.5 * d / (0.12 * s);
    if (ratio <= 0) return 0;
    open = std::fmin(open, ratio);
    s += std::fmax(0.7 * d, 0.025 * size);
  }
  return open * open * (3 - 2 * open);
}

}  // namespace

Vec3d vertex_light(Field field, const Vec3d& p, const Vec3d& normal, const VertexLightOptions& options) {
  const Vec3d to_key = normalized(options.to_key);
  const double facing = dot(normal, to_key);
  const double ambient = openness(field, p, normal, options.size);
  const double key = facing > 0 ? facing * key_visibility(field, p, normal, to_key, options.size) : 0;
  const double sky = 0.5 + 0.5 * normal.y;
  const Vec3d light = Vec3d(0.50, 0.54, 0.62) * (ambient * (0.55 + 0.45 * sky)) + Vec3d(0.62, 0.57, 0.48) * key +
                      Vec3d(0.10, 0.08, 0.07) * (ambient * (1 - sky));
  return Vec3d(1, 1, 1) * (1 - options.strength) + light * options.strength;
}

}  // namespace etalon::procedural
