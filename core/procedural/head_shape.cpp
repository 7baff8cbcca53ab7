#include "core/procedural/head_shape.h"

#include <cmath>

namespace etalon::procedural {

namespace {

constexpr double kBaseHeight = -1.36;
constexpr double kScallops = 5.5;
constexpr double kCrestThickness = 0.16;  ///< half, at the root

const Vec3d kCrestCenter(0, 0.10, -0.02);
const Vec3d kCrestAxis(0, 0.80, -0.60);  // toward the highest point of the crest

/// The sail: a slab that thins toward its scalloped edge.
double crest_field(const Vec3d& q) {
  const Vec3d d = q - kCrestCenter;
  const double r = std::sqrt(d.y * d.y + d.z * d.z) + 1e-9;
  const double along = (d.y * kCrestAxis.y + d.z * kCrestAxis.z) / r;
  const double across = (d.z * kCrestAxis.y - d.y * kCrestAxis.z) / r;  // sine of the angle from the axis, forward positive
  const double spread = across > 0 ? smooth_step(0.25, 1.0, along) : smooth_step(-0.15, 1.0, along);
  const double scallop = 0.045 * cos_turns(across * kScallops * 0.5) * smooth_step(0.1, 0.6, spread);
  const double edge = 0.42 + 0.92 * spread + scallop;
  const double thickness = mix(kCrestThickness, 0.05, clamp01((r - 0.4) / (edge - 0.3)));
  return smooth_max((r - edge) * 0.75, std::fabs(q.x) - thickness, 0.09);
}

}  // namespace

const HeadEye& head_eye() {
  static const HeadEye kEye{{0.325, 0.335, 0.40}, 0.225, normalized(Vec3d(0.70, 0.08, 0.71))};
  return kEye;
}

double mouth_height(double z) {
  const double t = clamp01((z - 0.25) / 1.25);
  const double corner = (1 - t) * (1 - t) * (1 - t);
  return 0.02 - 0.28 * t * (1 - 0.52 * t) + 0.075 * corner * corner;  // falls to the front, turns up at the corner
}

CrestPlace crest_place(const Vec3d& p) {
  const Vec3d d = p - kCrestCenter;
  const double r = std::sqrt(d.y * d.y + d.z * d.z) + 1e-9;
  const double along = (d.y * kCrestAxis.y + d.z * kCrestAxis.z) / r;
  const double across = (d.z * kCrestAxis.y - d.y * kCrestAxis.z) / r;
  const double spread = across > 0 ? smooth_step(0.25, 1.0, along) : smooth_step(-0.15, 1.0, along);
  const double edge = 0.42 + 0.92 * spread;
  constexpr double kRoot = 0.60;
  return {clamp01((r - kRoot) / std::fmax(edge - kRoot, 0.3)) * smooth_step(0.05, 0.3, spread) * smooth_step(edge + 0.14, edge + 0.05, r),
          across * kScallops * 0.5};
}

double head_field(const Vec3d& p) {
  const Vec3d q(std::fabs(p.x), p.y, p.z);
  const Vec3d squeezed(q.x * 0.86, q.y, q.z);

  double d = ellipsoid(q, {0, 0.26, -0.04}, {0.52, 0.50, 0.60});                                  // skull
  d = smooth_min(d, round_cone(squeezed, {0, 0.20, 0.25}, {0, 0.04, 0.98}, 0.36, 0.22), 0.22);    // muzzle
  d = smooth_min(d, ellipsoid(q, {0, -0.02, 1.20}, {0.39, 0.19, 0.36}), 0.16);                    // bill
  d = smooth_min(d, round_cone(squeezed, {0, -0.14, 0.10}, {0, -0.26, 0.95}, 0.32, 0.15), 0.10);  // jaw
  d = smooth_min(d, ellipsoid(q, {0, -0.28, 1.08}, {0.33, 0.12, 0.34}), 0.08);                    // lower bill
  d = smooth_min(d, round_cone(q, {0.28, -0.06, 0.24}, {0.24, 0.0, 0.52}, 0.24, 0.17), 0.16);     // cheek
  d = smooth_min(d, round_cone(q, {0, 0.05, -0.22}, {0, -1.7, -0.62}, 0.44, 0.70), 0.26);         // neck
  // Parts that a bound shows to lie farther than the blend reaches change nothing: smooth_min(a, b, k) = a where b >= a + k.
  if (q.x - kCrestThickness < d + 0.14) d = smooth_min(d, crest_field(q), 0.14);

  // Mouth: a groove that ends in the cheek.
  const double mouth = bump(q.y - mouth_height(q.z), 0.05) * smooth_step(0.22, 0.36, q.z);
  d += 0.035 * mouth;
  // Nostrils, with a raised rim.
  const double to_nostril = length((q - Vec3d(0.17, 0.135, 1.33)) * Vec3d(1, 1, 0.7));
  d += 0.05 * bump(to_nostril, 0.075) - 0.022 * bump(to_nostril, 0.15);

  // Eye: the ball, brow above it, lids as slightly larger shells cut by planes.
  const HeadEye& eye = head_eye();
  const Vec3d e = q - eye.center;
  d = smooth_min(d, round_cone(q, {0.27, 0.575, 0.16}, {0.235, 0.60, 0.44}, 0.095, 0.07), 0.12);
  const double from_eye = length(e);
  const double shell = from_eye - (eye.radius + 0.028);
  if (shell - 0.01 < d + 0.05) {
    static const Vec3d kUpper = normalized(Vec3d(0.10, 1.0, -0.10)), kLower = normalized(Vec3d(-0.22, -1.0, -0.10));
    const double upper_lid = smooth_max(shell, 0.178 - dot(e, kUpper), 0.025);
    const double lower_lid = smooth_max(shell, 0.180 - dot(e, kLower), 0.025);
    d = smooth_min(d, smooth_min(upper_lid, lower_lid, 0.03), 0.05);  // 0.03/4 < 0.01
    d = smooth_min(d, from_eye - eye.radius, 0.02);
  }

  return smooth_max(d, kBaseHeight - p.y, 0.08);
}

double head_density(const Vec3d& p) {
  const HeadEye& eye = head_eye();
  const Vec3d q(std::fabs(p.x), p.y, p.z);
  const double face = smooth_step(-0.3, 0.5, p.z) * smooth_step(-0.9, -0.4, p.y);
  const double near_eye = bump(length(q - eye.center), 0.48);
  const double base = smooth_step(-0.6, -1.3, p.y);
  const double edge = smooth_step(0.55, 0.95, crest_place(p).rise);
  return 1 + 0.35 * face + 0.9 * near_eye + 0.5 * edge - 0.25 * base;
}

SpinePose head_spine(double t) {
  struct Key {
    double t, y, z, tilt, cone;  // tilt: dorsal direction from up toward the back, in turns; cone: of the rays toward forward, in turns
  };
  static constexpr Key kKeys[] = {
      {0.00, -0.10, 1.12, 0.000, 0.25}, {0.20, -0.10, 1.12, 0.000, 0.000}, {0.42, 0.05, 0.60, 0.024, 0.0},
      {0.56, 0.12, 0.12, 0.085, 0.0},   {0.68, 0.00, -0.15, 0.120, 0.0},   {0.80, -0.45, -0.30, 0.180, 0.0},
      {0.90, -0.95, -0.42, 0.25, 0.0},  {1.00, -0.95, -0.42, 0.25, -0.25},
  };
  std::size_t i = 0;
  while (i + 2 < std::size(kKeys) && t > kKeys[i + 1].t) ++i;
  const Key& a = kKeys[i];
  const Key& b = kKeys[i + 1];
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
