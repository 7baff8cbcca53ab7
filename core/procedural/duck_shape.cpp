#include "core/procedural/duck_shape.h"

#include <cmath>

namespace etalon::procedural {

namespace {

constexpr double kFloor = -0.44;

}  // namespace

const DuckEye& duck_eye() {
  static const DuckEye kEye{{0.243, 1.085, 0.915}, 0.060};
  return kEye;
}

double duck_wing(const Vec3d& p) {
  // A long drop in the (z, y) plane: round at the shoulder, pointed over the tail.
  const double along = clamp01((0.42 - p.z) / 1.45);
  const double middle = 0.13 + 0.16 * along * along, half = mix(0.30, 0.03, along * along) * smooth_step(-0.05, 0.25, along + 0.05);
  return std::fmax(std::fabs(p.y - middle) - half, std::fmax(p.z - 0.42, -1.06 - p.z));
}

double duck_field(const Vec3d& p) {
  const Vec3d q(std::fabs(p.x), p.y, p.z);
  double d = ellipsoid(q, {0, -0.02, -0.06}, {0.60, 0.50, 1.02});                                                     // body
  d = smooth_min(d, ellipsoid(q, {0, 0.06, 0.52}, {0.47, 0.50, 0.46}), 0.25);                                         // breast
  d = smooth_min(d, round_cone(Vec3d(q.x * 0.62, q.y, q.z), {0, 0.08, -0.72}, {0, 0.36, -1.34}, 0.24, 0.075), 0.22);  // tail
  d = smooth_min(d, round_cone(q, {0, 0.22, 0.62}, {0, 0.82, 0.74}, 0.32, 0.215), 0.26);                              // neck
  d = smooth_min(d, ellipsoid(q, {0, 1.03, 0.83}, {0.262, 0.265, 0.33}), 0.12);                                       // head
  d = smooth_min(d, round_cone(Vec3d(q.x * 1.15, q.y, q.z), {0, 1.10, 0.66}, {0, 0.74, 0.36}, 0.20, 0.10), 0.14);     // crest
  d = smooth_min(d, ellipsoid(q, {0.12, 0.97, 0.92}, {0.165, 0.135, 0.20}), 0.08);                                    // cheek
  d = smooth_min(d, round_cone(Vec3d(q.x * 0.80, q.y, q.z), {0, 0.99, 1.06}, {0, 0.93, 1.40}, 0.120, 0.062), 0.06);   // bill
  d += 0.010 * bump(q.y - 0.945 + 0.10 * (q.z - 1.10), 0.018) * smooth_step(1.06, 1.14, q.z);                         // its gape
  d += 0.020 * bump(length((q - Vec3d(0.062, 1.035, 1.24)) * Vec3d(1, 1.6, 0.7)), 0.035);                             // nostril
  // The wing: a shallow shell with a lower edge; feather tips as steps toward the tail.
  const double outline = duck_wing(q);
  d -= 0.055 * smooth_step(0.05, -0.07, outline) * smooth_step(0.18, 0.34, q.x + 0.35 * smooth_step(-0.2, -0.9, q.z));
  d -= 0.010 * bump(outline + 0.105, 0.035) * smooth_step(0.2, 0.3, q.x);
  const DuckEye& eye = duck_eye();
  const double from_eye = length(q - eye.center);
  d = smooth_min(d, from_eye - eye.radius, 0.02);
  return smooth_max(d, kFloor - p.y, 0.06);
}

SpinePose duck_spine(double t) {
  struct Key {
    double t, y, z, tilt, cone;  // tilt: dorsal direction from up toward the back, in turns; cone: of the rays toward forward, in turns
  };
  // Two turns around pivots outside the body, so that the planes of the rings meet nowhere inside it: the throat (y 0.68, z 1.20, radius
  // 0.34) and the nape (y 0.66, z 0.10, radius 0.58): center = pivot ± radius·dorsal.
  static const std::array<Key, 17> kKeys = [] {
    std::array<Key, 17> keys{};
    keys[0] = {0.00, 0.925, 1.33, 0, 0.25};
    keys[1] = {0.05, 0.925, 1.33, 0, 0};
    keys[2] = {0.14, 0.99, 1.24, 0, 0};
    for (int i = 0; i <= 4; ++i) {
      const double tilt = 0.25 * i / 4;
      keys[static_cast<std::size_t>(3 + i)] = {0.17 + 0.045 * i, 0.68 + 0.34 * cos_turns(tilt), 1.20 - 0.34 * sin_turns(tilt), tilt, 0};
    }
    for (int i = 0; i <= 4; ++i) {
      const double tilt = 0.25 - 0.25 * i / 4;
      keys[static_cast<std::size_t>(8 + i)] = {0.38 + 0.06 * i, 0.66 - 0.58 * cos_turns(tilt), 0.10 + 0.58 * sin_turns(tilt), tilt, 0};
    }
    keys[13] = {0.74, 0.05, -0.45, 0, 0};
    keys[14] = {0.86, 0.18, -0.90, -0.045, 0};
    keys[15] = {0.94, 0.30, -1.22, -0.07, 0};
    keys[16] = {1.00, 0.30, -1.22, -0.07, -0.25};
    return keys;
  }();
  std::size_t i = 0;
  while (i + 2 < kKeys.size() && t > kKeys[i + 1].t) ++i;
  const Key &a = kKeys[i], &b = kKeys[i + 1];
  const double s = clamp01((t - a.t) / (b.t - a.t));
  const double tilt = mix(a.tilt, b.tilt, s), cone = mix(a.cone, b.cone, s);
  SpinePose pose;
  pose.center = {0, mix(a.y, b.y, s), mix(a.z, b.z, s)};
  pose.dorsal = {0, cos_turns(tilt), -sin_turns(tilt)};
  pose.forward = {0, sin_turns(tilt), cos_turns(tilt)};
  pose.cone_cos = t <= 0 || t >= 1 ? 0 : cos_turns(cone);
  pose.cone_sin = t <= 0 ? 1 : (t >= 1 ? -1 : sin_turns(cone));
  return pose;
}

}  // namespace etalon::procedural
