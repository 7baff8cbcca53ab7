// A toy soldier on guard, from the front: bearskin, tunic with belts, arms before the chest, a rifle in front of all, on a stand.
#include "core/procedural/noise.h"
#include "core/procedural/scan_shapes.h"

namespace etalon::procedural {

namespace {

constexpr double kMiddle = 24;  ///< depth of the body's middle plane

double stand_and_legs(const Vec3d& q) {
  const Vec3d p(std::fabs(q.x), q.y, q.z);
  double d = rounded_box(q, {0, -93, kMiddle}, {36, 4.5, 22}, 2);
  const double leg = round_cone(p, {12, -78, kMiddle}, {10.5, -14, kMiddle}, 8.6, 12.5);
  double boot = round_cone(p, {13, -84, kMiddle - 2}, {15.5, -85.5, kMiddle + 15}, 8, 6.4);
  boot = smooth_min(boot, round_cone(p, {12.5, -82, kMiddle}, {11.8, -58, kMiddle}, 9.6, 11), 5);
  d = std::fmin(d, std::fmin(leg + 0.5 * bump(p.x - 11.5, 1.0) * smooth_step(0, 4, q.z - kMiddle), boot));
  return d;
}

double tunic(const Vec3d& q) {
  // Chest and skirt, with a belt, a collar, two rows of buttons and belts that cross.
  double d = round_cone(Vec3d(q.x * 0.72, q.y, q.z), {0, -4, kMiddle}, {0, 26, kMiddle}, 14, 16.5);
  d = smooth_min(d, round_cone(Vec3d(q.x * 0.66, q.y, q.z), {0, -30, kMiddle}, {0, -4, kMiddle}, 16.8, 14), 4);
  d = smooth_max(d, -33 - q.y, 1.2);
  const double front = smooth_step(2, 8, q.z - kMiddle);
  d -= 1.5 * smooth_step(0.4, -0.4, std::fabs(q.y + 2) - 3.6);  // belt
  d -= 0.9 * smooth_step(0.4, -0.4, std::fmax(std::fabs(q.x) - 4.6, std::fabs(q.y + 2) - 4.8)) * front;
  const double above = smooth_step(1, 3, q.y);
  for (int side = -1; side <= 1; side += 2) {
    const double strap = std::fabs(q.x * 0.8 - side * (q.y - 17) * 0.72);
    d -= 0.9 * smooth_step(3.4, 2.6, strap) * above * front;
  }
  d += 0.7 * bump(q.x, 0.9) * front;
  for (int k = 0; k < 4; ++k) d = smooth_min(d, length(q - Vec3d(6.8, 9.0 + 8 * k, kMiddle + 15.2)) - 1.9, 0.4);
  for (int k = 0; k < 4; ++k) d = smooth_min(d, length(q - Vec3d(-6.8, 9.0 + 8 * k, kMiddle + 15.2)) - 1.9, 0.4);
  const double folds = sin_turns(q.x / 9.5) * smooth_step(-6, -24, q.y);
  return d + 0.5 * folds * front;
}

double head(const Vec3d& q) {
  const Vec3d p(std::fabs(q.x), q.y, q.z);
  double d = ellipsoid(q, {0, 54, kMiddle + 1}, {10.6, 13, 12.2});
  d = smooth_min(d, round_cone(q, {0, 38, kMiddle}, {0, 48, kMiddle}, 8, 7.6), 3);
  d = smooth_min(d, round_cone(q, {0, 57, kMiddle + 12.5}, {0, 51.5, kMiddle + 14.6}, 1.4, 2.3), 1.6);  // nose
  d = smooth_max(d, -(length(p - Vec3d(4.3, 56.5, kMiddle + 13.4)) - 2.3), 1.4);                        // sockets
  d = smooth_min(d, length(p - Vec3d(4.2, 56.3, kMiddle + 10.2)) - 2.0, 0.5);
  d = smooth_min(d, round_cone(p, {1.2, 48.6, kMiddle + 12.6}, {5.4, 47.6, kMiddle + 10.6}, 1.3, 0.7), 0.8);  // moustache
  d += 0.6 * bump(q.y - 45.6, 1.0) * bump(q.x, 5) * smooth_step(5, 9, q.z - kMiddle);
  d = smooth_min(d, ellipsoid(q, {0, 42.8, kMiddle + 9.6}, {4.4, 3.0, 3.4}), 2);  // chin
  d = smooth_min(d, ellipsoid(p, {10.6, 53, kMiddle - 1}, {2, 4.2, 3}), 0.8);
  // The bearskin: a tall cap with tufts, and its chain.
  double cap = round_cone(q, {0, 66, kMiddle}, {0, 80, kMiddle}, 15.6, 14.4);
  cap = smooth_max(cap, 60.5 + 0.10 * p.x - q.y, 2);
  cap += 0.9 * value_noise({q.x / 3.4 + 0.2 * q.y, q.y / 8.0, q.z / 5.0}, 17);
  const double collar = rounded_disc(length2(q.x, q.z - kMiddle), q.y - 38.5, 10.4, 3.4, 1.2);
  return std::fmin(std::fmin(d, cap * 0.85), collar);
}

double arms_and_rifle(const Vec3d& q) {
  // The right hand (−x) at the stock, the left one at the barrel.
  double d = round_cone(q, {-25, 26, kMiddle}, {-33, 2, kMiddle + 4}, 9.6, 7.6);
  d = smooth_min(d, round_cone(q, {-33, 2, kMiddle + 4}, {-13, -8, kMiddle + 26}, 7.6, 6), 2.5);
  double left = round_cone(q, {25, 26, kMiddle}, {35, 6, kMiddle + 4}, 9.6, 7.6);
  left = smooth_min(left, round_cone(q, {35, 6, kMiddle + 4}, {15, 19, kMiddle + 26}, 7.6, 6), 2.5);
  d = std::fmin(d, left);
  const Vec3d p(std::fabs(q.x), q.y, q.z);
  d = std::fmin(d, ellipsoid(p, {24.5, 34.5, kMiddle}, {9.6, 3.4, 9.6}));  // epaulettes
  d = smooth_min(d, ellipsoid(q, {-11, -8.5, kMiddle + 27}, {6.4, 6.8, 6}), 1.5);
  d = smooth_min(d, ellipsoid(q, {14, 19.5, kMiddle + 27}, {6.4, 6.8, 6}), 1.5);
  const Vec3d a(-27, -28, kMiddle + 29), b(33, 42, kMiddle + 29);
  const Vec3d way = normalized(b - a);
  const Vec3d side = normalized(cross(Vec3d(0, 0, 1), way));
  const Vec3d from = q - a;
  const Vec3d local(dot(from, way), dot(from, side), q.z - a.z);
  double rifle = rounded_box(local, {9, -1, 0}, {13, 5.0 - 0.09 * clamp01(local.x / 22) * 22, 2.6}, 1.2) * 0.9;  // butt
  rifle = smooth_min(rifle, rounded_box(local, {38, 0, 0}, {24, 2.6, 2.4}, 1.2), 2);
  rifle = std::fmin(rifle, round_cone(local, {30, 0, 1.4}, {92, 0, 1.4}, 1.9, 1.7));
  for (int k = 0; k < 3; ++k) rifle = std::fmin(rifle, rounded_disc(length2(local.y, local.z - 0.6), local.x - 44 - 13 * k, 3.0, 1.1, 0.5));
  return std::fmin(d, rifle);
}

}  // namespace

double soldier_field(const Vec3d& p) {
  double d = std::fmin(stand_and_legs(p), tunic(p));
  d = std::fmin(d, head(p));
  return std::fmin(d, arms_and_rifle(p));
}

}  // namespace etalon::procedural
