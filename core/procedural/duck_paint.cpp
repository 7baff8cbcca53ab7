#include "core/procedural/duck_paint.h"

#include <cmath>

#include "core/procedural/duck_shape.h"
#include "core/procedural/noise.h"
#include "core/procedural/vertex_light.h"

namespace etalon::procedural {

namespace {

Vec3d rgb(int r, int g, int b) { return {r / 255.0, g / 255.0, b / 255.0}; }

/// 1 within `half` of the polyline's segment a-b, seen from the side; edges softened.
double stroke(const Vec3d& p, const Vec2d& a, const Vec2d& b, double half_a, double half_b) {
  const Vec2d d(b.x - a.x, b.y - a.y), v(p.z - a.x, p.y - a.y);
  const double t = clamp01((v.x * d.x + v.y * d.y) / (d.x * d.x + d.y * d.y));
  const double away = length(Vec3d(v.x - d.x * t, v.y - d.y * t, 0)), half = mix(half_a, half_b, t);
  return smooth_step(half + 0.008, half - 0.008, away);
}

Vec3d head_color(const Vec3d& p, const Vec3d& q) {
  const double shimmer = fractal_noise(Vec3d(p.x * 14, p.y * 5, p.z * 5), 3, 41);
  const Vec3d green = mix(rgb(14, 84, 66), rgb(46, 152, 104), smooth_step(-0.5, 0.6, shimmer));
  const Vec3d violet = mix(rgb(48, 28, 92), rgb(104, 62, 150), smooth_step(-0.5, 0.6, shimmer));
  Vec3d color = mix(green, violet, smooth_step(1.04, 0.92, p.y + 0.20 * (0.8 - p.z)) * smooth_step(0.2, 0.7, p.z));
  color = mix(color, rgb(22, 34, 92), smooth_step(0.62, 0.42, p.z));
  // The white lines: over the eye into the crest, behind the eye, and the bridle with its two prongs.
  double white = stroke(q, {1.08, 1.075}, {0.86, 1.185}, 0.012, 0.018);
  white = std::fmax(white, stroke(q, {0.86, 1.185}, {0.62, 1.10}, 0.018, 0.022));
  white = std::fmax(white, stroke(q, {0.62, 1.10}, {0.36, 0.78}, 0.022, 0.012));
  white = std::fmax(white, stroke(q, {0.80, 1.055}, {0.58, 0.94}, 0.010, 0.016));
  white = std::fmax(white, stroke(q, {0.58, 0.94}, {0.36, 0.70}, 0.016, 0.012));
  white *= smooth_step(0.05, 0.10, q.x);
  const double throat = smooth_step(0.045, 0.015, p.y - 0.86 + 0.45 * smooth_step(1.02, 0.78, p.z) - 0.10 * smooth_step(1.0, 1.12, p.z));
  double bridle = throat * smooth_step(0.70, 0.78, p.z + 0.3 * smooth_step(0.85, 0.7, p.y));
  bridle = std::fmax(bridle, stroke(q, {0.98, 0.80}, {0.80, 0.985}, 0.060, 0.016));
  bridle = std::fmax(bridle, stroke(q, {0.90, 0.66}, {0.60, 0.73}, 0.055, 0.018));
  return mix(color, rgb(246, 244, 236), std::fmax(white, bridle * smooth_step(0.50, 0.56, p.y)));
}

Vec3d bill_color(const Vec3d& p, const Vec3d& q) {
  Vec3d color = mix(rgb(206, 44, 34), rgb(232, 226, 214), smooth_step(1.13, 1.16, p.z) * smooth_step(0.95, 0.97, p.y));
  color = mix(color, rgb(26, 22, 24), smooth_step(0.035, 0.02, q.x) * smooth_step(0.97, 1.0, p.y));
  color = mix(color, rgb(22, 18, 20), smooth_step(1.345, 1.375, p.z));
  color = mix(color, rgb(240, 196, 60), bump(p.z - 1.075, 0.022));
  return mix(color, rgb(24, 12, 12), smooth_step(0.028, 0.016, length((q - Vec3d(0.062, 1.035, 1.24)) * Vec3d(1, 1.6, 0.7))));
}

Vec3d body_color(const Vec3d& p, const Vec3d& q) {
  const double grain = fractal_noise(Vec3d(p.x * 3, p.y * 26, p.z * 2.2), 3, 5);
  // Breast: chestnut, with flecks that grow toward the belly.
  Vec3d breast = mix(rgb(112, 40, 26), rgb(148, 66, 40), smooth_step(-0.5, 0.6, grain));
  const Cells flecks = cellular_noise(Vec3d(p.x * 15, p.y * 12, p.z * 15), 71);
  breast = mix(breast, rgb(250, 240, 222),
               smooth_step(0.05, 0.0, flecks.nearest - mix(0.14, 0.30, smooth_step(0.35, -0.3, p.y))) * smooth_step(0.34, 0.20, p.y));
  // Flank: gold with fine dark waves; its upper rim barred black and white.
  const double wave = sin_turns(26 * (p.z + 0.10 * sin_turns(2.2 * p.y)) + 1.1 * fractal_noise(p * 5.0, 2, 9));
  Vec3d flank = mix(rgb(214, 164, 84), rgb(236, 196, 122), smooth_step(-0.5, 0.6, grain));
  flank = mix(flank, rgb(112, 74, 34), 0.55 * smooth_step(0.45, 0.85, wave));
  const double bars = smooth_step(-0.15, 0.15, sin_turns(9.5 * p.z + 0.6 * (p.y - 0.1)));
  const double rim = bump(duck_wing(q) - 0.035, 0.055) * smooth_step(-0.05, 0.02, 0.16 - p.y);
  flank = mix(flank, mix(rgb(20, 20, 24), rgb(246, 244, 238), bars), smooth_step(0.2, 0.5, rim));
  Vec3d color = mix(flank, breast, smooth_step(0.36, 0.42, p.z + 0.12 * p.y));
  // The bar between them: white, then black.
  const double bar = p.z + 0.12 * p.y - 0.355;
  const double side = smooth_step(-0.34, -0.26, p.y) * smooth_step(0.36, 0.28, p.y);
  color = mix(color, rgb(248, 246, 240), smooth_step(0.045, 0.035, std::fabs(bar)) * side);
  color = mix(color, rgb(16, 16, 20), smooth_step(0.030, 0.020, std::fabs(bar + 0.068)) * side);
  // Belly white, back bronze to blue, tail dark.
  color = mix(color, rgb(240, 234, 222), smooth_step(-0.29, -0.36, p.y + 0.03 * grain));
  const Vec3d back = mix(rgb(34, 40, 52), mix(rgb(30, 92, 104), rgb(88, 70, 40), smooth_step(-0.6, 0.6, grain)), 0.6);
  color = mix(color, back, smooth_step(0.34, 0.40, p.y + 0.06 * smooth_step(0.1, -0.6, p.z)) * smooth_step(0.40, 0.34, p.z + 0.12 * p.y));
  return mix(color, rgb(26, 26, 32), smooth_step(-0.86, -0.98, p.z + 0.25 * (p.y - 0.25)));
}

/// Scapulars, blue speculum edged white, long primaries: rows of scallops drawn in colour.
Vec3d wing_color(const Vec3d& p) {
  const double along = (0.42 - p.z) / 1.45;
  const double row = along * 8, column = (p.y - 0.13 - 0.16 * along * along) * 8 + (std::floor(row) - 2 * std::floor(row / 2)) * 0.5;
  const double u = column - std::floor(column) - 0.5, v = row - std::floor(row);
  const double scallop = v + 1.6 * u * u;
  Vec3d feather = mix(rgb(44, 54, 66), rgb(92, 84, 66), smooth_step(-0.4, 0.6, fractal_noise(p * 4.0, 3, 15)));
  feather = mix(feather, mix(rgb(26, 66, 170), rgb(52, 150, 190), smooth_step(-0.4, 0.6, fractal_noise(p * 5.0, 2, 19))),
                smooth_step(0.40, 0.46, along) * smooth_step(0.74, 0.68, along) * smooth_step(0.26, 0.20, p.y));
  feather = mix(feather, rgb(240, 240, 236), smooth_step(0.030, 0.018, std::fabs(along - 0.755)) * smooth_step(0.30, 0.24, p.y));
  feather *= 0.92 + 0.22 * smooth_step(0.2, 0.9, v);
  return mix(feather, rgb(16, 16, 20), 0.85 * smooth_step(0.13, 0.04, std::fabs(scallop - 0.84)));
}

}  // namespace

Vec3d duck_color(const Vec3d& p) {
  const Vec3d q(std::fabs(p.x), p.y, p.z);
  const Vec3d normal = field_normal(duck_field, p, 3e-3);
  const VertexLightOptions lamp{.to_key = {0.45, 0.80, 0.55}, .size = 1.3, .strength = 0.72};
  const Vec3d light = vertex_light(duck_field, p, normal, lamp) * 1.15;
  const DuckEye& eye = duck_eye();
  const double from_eye = length(q - eye.center);
  if (from_eye < eye.radius + 0.003) {
    const Vec3d d = (q - eye.center) * (1 / eye.radius);
    const double r = length(Vec3d(d.y, d.z - 0.20, 0));
    Vec3d color = mix(rgb(14, 10, 10), rgb(214, 36, 24), smooth_step(0.40, 0.48, r));
    color = mix(color, rgb(255, 255, 250), smooth_step(0.16, 0.10, length(Vec3d(d.y - 0.30, d.z - 0.30, 0))));
    return color * (Vec3d(0.4, 0.4, 0.4) + light * 0.6);
  }
  // The head's colours end in a clean line around the neck.
  const double collar = p.y - 0.50 - 0.30 * (0.7 - p.z);
  Vec3d color = mix(body_color(p, q), head_color(p, q), smooth_step(-0.008, 0.008, collar));
  color = mix(color, wing_color(q),
              smooth_step(0.004, -0.012, duck_wing(q)) * smooth_step(0.14, 0.22, q.x + 0.3 * smooth_step(-0.3, -0.9, q.z)));
  const double bill = smooth_step(1.065, 1.085, p.z - 0.10 * bump(q.y - 1.06, 0.08) * smooth_step(0.1, 0.0, q.x));
  color = mix(color, bill_color(p, q), bill);
  color = mix(color, rgb(226, 104, 30), 0.85 * bump(from_eye - eye.radius - 0.010, 0.020));
  return color * light;
}

}  // namespace etalon::procedural
