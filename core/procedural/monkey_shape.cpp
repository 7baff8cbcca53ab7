#include "core/procedural/monkey_shape.h"

#include <cmath>

#include "core/procedural/noise.h"

namespace etalon::procedural {

namespace {

constexpr double kBase = -1.22;
const Vec3d kEar(0.86, 0.20, -0.10);
/// Across the ear's disc: outward and forward.
const Vec3d kEarAxis = normalized(Vec3d(0.38, 0.02, 0.92));
const Vec3d kEarSide = normalized(cross(Vec3d(0, 1, 0), kEarAxis));

/// In the ear's frame: along its side, up, across.
Vec3d ear_place(const Vec3d& q) {
  const Vec3d d = q - kEar;
  return {dot(d, kEarSide), d.y, dot(d, kEarAxis)};
}

}  // namespace

const MonkeyEye& monkey_eye() {
  static const MonkeyEye kEye{{0.235, 0.215, 0.575}, 0.145, normalized(Vec3d(0.20, 0.0, 0.98))};
  return kEye;
}

double monkey_mouth(double x) { return -0.445 + 0.16 * x * x - 0.02 * bump(x, 0.12); }

double monkey_face(const Vec3d& p) {
  const Vec3d q(std::fabs(p.x), p.y, p.z);
  // A heart: two lobes above the eyes, down over the muzzle.
  const double lobe = length((q - Vec3d(0.24, 0.26, 0.60)) * Vec3d(1.0, 1.05, 0.55)) - 0.33;
  const double snout = length((q - Vec3d(0, -0.28, 0.75)) * Vec3d(1.0, 0.82, 0.55)) - 0.44;
  const double edge = smooth_min(lobe, snout, 0.15) + 0.03 * fractal_noise(p * 7.0, 3, 501);
  return smooth_step(0.05, -0.03, edge) * smooth_step(0.05, 0.25, p.z);
}

double monkey_ear_cup(const Vec3d& p) {
  const Vec3d e = ear_place({std::fabs(p.x), p.y, p.z});
  const double r = length(Vec3d(e.x / 0.21, e.y / 0.25, 0));
  return smooth_step(1.02, 0.80, r) * smooth_step(-0.06, 0.0, e.z);
}

double monkey_field(const Vec3d& p) {
  const Vec3d q(std::fabs(p.x), p.y, p.z);

  double d = ellipsoid(q, {0, 0.20, -0.12}, {0.74, 0.76, 0.74});                                  // skull
  d = smooth_min(d, round_cone(q, {0, 0.62, -0.18}, {0, 0.80, -0.05}, 0.34, 0.20), 0.25);         // crown
  d = smooth_min(d, ellipsoid(q, {0.40, -0.16, 0.22}, {0.36, 0.38, 0.36}), 0.20);                 // cheek
  d = smooth_min(d, round_cone(q, {0, -0.16, 0.36}, {0, -0.33, 0.86}, 0.36, 0.29), 0.16);         // muzzle
  d = smooth_min(d, ellipsoid(q, {0.15, -0.30, 0.90}, {0.21, 0.17, 0.24}), 0.10);                 // upper lip, two pads
  d = smooth_min(d, ellipsoid(q, {0, -0.53, 0.74}, {0.27, 0.15, 0.28}), 0.10);                    // chin
  d = smooth_min(d, round_cone(q, {0.09, 0.06, 0.60}, {0.10, -0.12, 0.96}, 0.070, 0.105), 0.09);  // ridges beside the nose
  d = smooth_min(d, round_cone(q, {0, 0.20, 0.62}, {0, -0.13, 1.09}, 0.065, 0.085), 0.07);        // bridge
  d = smooth_min(d, ellipsoid(q, {0.075, -0.165, 1.09}, {0.105, 0.080, 0.085}), 0.07);            // nose
  d = smooth_min(d, round_cone(q, {0.02, 0.395, 0.60}, {0.38, 0.38, 0.42}, 0.105, 0.09), 0.10);   // brow
  d = smooth_min(d, round_cone(q, {0, -0.20, -0.20}, {0, -1.6, -0.34}, 0.52, 0.66), 0.26);        // neck
  d = smooth_min(d, round_cone(q, {0.30, -0.50, 0.30}, {0.07, -0.98, 0.42}, 0.26, 0.13), 0.22);   // beard
  d = smooth_min(d, round_cone(q, {0.52, -0.08, 0.02}, {0.70, -0.48, 0.02}, 0.26, 0.10), 0.20);   // whiskers

  // Ear: a disc with a rolled rim and a cup.
  const Vec3d e = ear_place(q);
  if (length(e) < 0.6) {
    const double ring = length(Vec3d(e.x / 0.27, e.y / 0.32, 0));
    const double disc =
        std::sqrt(e.z * e.z + 0.0001) - 0.088 - 0.020 * bump(ring - 0.93, 0.20) + 0.045 * bump(ring, 0.8) * smooth_step(-0.02, 0.03, e.z);
    d = smooth_min(d, smooth_max((ring - 1) * 0.27, disc, 0.06), 0.07);
    d += 0.05 * bump(length(e - Vec3d(0.03, -0.02, 0.05)), 0.13);
  }

  // Mouth, nostrils, sockets.
  d += 0.030 * bump(q.y - monkey_mouth(q.x), 0.042) * smooth_step(0.52, 0.66, q.z) * smooth_step(0.40, 0.30, q.x);
  d += 0.060 * bump(length((q - Vec3d(0.068, -0.185, 1.165)) * Vec3d(1, 1.25, 0.8)), 0.055);
  const MonkeyEye& eye = monkey_eye();
  const double from_eye = length(q - eye.center);
  d = smooth_max(d, 0.17 - length((q - Vec3d(0.25, 0.215, 0.70)) * Vec3d(1, 1.15, 1)), 0.10);

  // Lids: a larger shell cut by planes; then the ball.
  if (from_eye < 0.4) {
    static const Vec3d kUpper = normalized(Vec3d(0.10, 1.0, 0.05)), kLower = normalized(Vec3d(-0.10, -1.0, 0.05));
    const Vec3d v = q - eye.center;
    const double shell = from_eye - (eye.radius + 0.022);
    const double upper = smooth_max(shell, 0.075 - dot(v, kUpper), 0.02), lower = smooth_max(shell, 0.100 - dot(v, kLower), 0.02);
    d = smooth_min(d, smooth_min(upper, lower, 0.02), 0.04);
    d = smooth_min(d, from_eye - eye.radius, 0.012);
  }

  // Fur: low tufts that run back and down; none on the skin.
  if (std::fabs(d) < 0.2) {
    const double furry = (1 - monkey_face(p)) * (1 - monkey_ear_cup(p)) * smooth_step(0.10, 0.25, from_eye);
    if (furry > 0) {
      const Vec3d along(p.x * 9, p.y * 3.2 + 4 * p.z * p.z, p.z * 5);
      d -= furry * mix(0.3, 1, smooth_step(0.30, 0.55, length(e))) *
           (0.022 * fractal_noise(along, 3, 811) + 0.010 * value_noise(p * 22.0, 77));
    }
  }
  return smooth_max(d, kBase - p.y, 0.08);
}

}  // namespace etalon::procedural
