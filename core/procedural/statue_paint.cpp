#include "core/procedural/statue_paint.h"

#include <cmath>

#include "core/procedural/noise.h"
#include "core/procedural/statue_shape.h"
#include "core/procedural/vertex_light.h"

namespace etalon::procedural {

namespace {

Vec3d rgb(int r, int g, int b) { return {r / 255.0, g / 255.0, b / 255.0}; }

/// 1 on a vein: thin sheets where a warped noise crosses zero, sharper the larger `sharp`.
double veins(const Vec3d& p, double scale, double sharp, std::uint64_t seed) {
  const Vec3d warp(fractal_noise(p * (1.3 * scale), 3, seed), fractal_noise(p * (1.3 * scale), 3, seed + 10),
                   fractal_noise(p * (1.3 * scale), 3, seed + 20));
  const double v = fractal_noise(p * scale + warp * 0.9, 4, seed + 30);
  return clamp01(1 - sharp * std::fabs(v));
}

Vec3d marble(const Vec3d& p, const Vec3d& ground, const Vec3d& cloud, const Vec3d& vein, std::uint64_t seed) {
  Vec3d color = mix(ground, cloud, smooth_step(-0.5, 0.8, fractal_noise(p * 1.9, 4, seed + 50)));
  const double broad = veins(p, 1.1, 7, seed), fine = veins(p, 2.3, 8, seed + 100);
  color = mix(color, vein, 0.80 * broad * broad);
  return mix(color, vein, 0.55 * fine * fine);
}

Vec3d gold(const Vec3d& p) { return mix(rgb(168, 108, 28), rgb(250, 212, 110), smooth_step(-0.5, 0.7, fractal_noise(p * 7.0, 3, 700))); }

/// Rosettes around the figure's axis in staggered rows: the angle enters by the sine and cosine of its multiple, so none is cut.
double rosettes(const Vec3d& p) {
  constexpr int kAround = 16;
  constexpr double kRow = 0.17;
  const double r = std::sqrt(p.x * p.x + p.z * p.z) + 1e-9, c = p.z / r, s = p.x / r;
  Vec2d turned(1, 0);
  for (int i = 0; i < kAround; ++i) turned = {turned.x * c - turned.y * s, turned.x * s + turned.y * c};
  const double row = std::floor(p.y / kRow), side = row - 2 * std::floor(row / 2) < 0.5 ? 1 : -1;
  if (turned.x * side < 0) return 0;
  const double along = turned.y * r / kAround, up = p.y - (row + 0.5) * kRow;
  const double d = length(Vec3d(along, up, 0)) + 1e-9,
               petals = up * up * (up * up - 6 * along * along) + along * along * along * along;  // d⁴·cos 4φ
  const double rim = 0.030 + 0.012 * petals / (d * d * d * d);
  return smooth_step(rim + 0.004, rim - 0.004, d) * (1 - smooth_step(0.013, 0.009, d));
}

Vec3d cloth(const Vec3d& p, StatuePart part, const Vec3d& ground) {
  const double border = statue_border(p, part);
  constexpr double kBand = 0.050;
  Vec3d color = ground;
  if (part == StatuePart::robe)
    color = mix(color, gold(p), 0.9 * rosettes(p) * smooth_step(0.07, 0.10, border) * smooth_step(1.45, 1.40, p.y));
  color = mix(color, gold(p), smooth_step(kBand + 0.006, kBand - 0.006, border));
  const double stitch = smooth_step(0.010, 0.004, std::fabs(border - 0.5 * kBand));
  return mix(color, rgb(120, 24, 34), 0.85 * stitch);
}

}  // namespace

Vec3d statue_color(const Vec3d& p) {
  const StatuePart part = statue_part(p);
  Vec3d color(0, 0, 0);
  switch (part) {
    case StatuePart::plinth: {
      color = marble(p, rgb(28, 62, 52), rgb(58, 104, 84), rgb(206, 222, 206), 31);
      const double panel = std::fmin(std::fabs(std::fmax(std::fabs(p.x) / 0.56, std::fabs(p.z) / 0.56) - 1) * 0.5, std::fabs(p.y + 0.26));
      if (p.y > -0.36 && p.y < -0.12) color = mix(color, gold(p), smooth_step(0.028, 0.018, std::fabs(p.y + 0.24)) * (panel >= 0 ? 1 : 0));
      break;
    }
    case StatuePart::robe: color = cloth(p, part, marble(p, rgb(226, 216, 200), rgb(204, 190, 172), rgb(92, 96, 110), 211)); break;
    case StatuePart::veil: color = cloth(p, part, marble(p, rgb(92, 126, 170), rgb(132, 164, 198), rgb(232, 234, 236), 401)); break;
    case StatuePart::skin: {
      color = marble(p, rgb(240, 226, 210), rgb(230, 212, 196), rgb(190, 172, 164), 611);
      const Vec3d q(std::fabs(p.x), p.y, p.z);
      color = mix(color, rgb(206, 120, 108), 0.75 * bump(length((q - Vec3d(0, 2.833, 0.31)) * Vec3d(0.6, 1.3, 0.8)), 0.036));
      color = mix(color, rgb(226, 150, 132), 0.30 * bump(length(q - Vec3d(0.115, 2.92, 0.25)), 0.09));
      color = mix(color, rgb(96, 70, 56),
                  0.8 * smooth_step(0.011, 0.006, std::fabs(q.y - 3.062 + 1.2 * (q.x - 0.07) * (q.x - 0.07))) *
                      smooth_step(0.018, 0.03, q.x) * smooth_step(0.145, 0.125, q.x) * smooth_step(0.15, 0.2, p.z));
      color = mix(color, rgb(70, 50, 42),
                  0.8 * smooth_step(0.010, 0.004, std::fabs(q.y - 2.990 - 2.2 * (q.x - 0.078) * (q.x - 0.078))) *
                      smooth_step(0.052, 0.044, std::fabs(q.x - 0.078)) * smooth_step(0.15, 0.2, p.z));
      break;
    }
    case StatuePart::hair: color = marble(p * 2.0, rgb(74, 52, 40), rgb(110, 80, 58), rgb(46, 32, 26), 811); break;
  }
  const Vec3d normal = field_normal(statue_field, p, 3e-3);
  const VertexLightOptions lamp{.to_key = {0.45, 0.70, 0.75}, .size = 1.6, .strength = 0.80};
  return color * (vertex_light(statue_field, p, normal, lamp) * 1.12);
}

}  // namespace etalon::procedural
