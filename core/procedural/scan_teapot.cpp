// A teapot from the side: a body turned on the wheel, a lid with its knob, a spout before and a handle behind the body's silhouette.
#include "core/procedural/scan_shapes.h"

#include <array>

namespace etalon::procedural {

namespace {

constexpr double kMiddle = 10;  ///< depth of the axis: the sensor sees the half before it

/// A chain of round cones through points of the middle plane.
struct Bead {
  double x, y, radius;
};
template <std::size_t kCount>
double chain(const Vec3d& q, const std::array<Bead, kCount>& beads, double k) {
  double d = 1e30;
  for (std::size_t i = 0; i + 1 < kCount; ++i) {
    const Bead &a = beads[i], &b = beads[i + 1];
    d = smooth_min(d, round_cone(q, {a.x, a.y, kMiddle}, {b.x, b.y, kMiddle}, a.radius, b.radius), k);
  }
  return d;
}

double body(const Vec3d& q) {
  const double r = length2(q.x, q.z - kMiddle);
  const Vec3d turned(r, q.y, 0);
  double d = ellipsoid(turned, {0, -10, 0}, {56, 42, 56});
  d = smooth_min(d, rounded_disc(r, q.y - 27, 35, 4.4, 1.5), 7);  // rim
  d = smooth_min(d, rounded_disc(r, q.y + 51, 34, 4.5, 1.5), 5);  // foot
  d = std::fmax(d, -54.5 - q.y);
  for (int k = 0; k < 2; ++k) d += 0.8 * bump(q.y - 14 + 46 * k, 1.5) * smooth_step(20, 30, r);  // turned grooves
  // A relief of leaves around the belly.
  const double band = bump(q.y + 9, 17);
  const double leaf = sin_turns(q.x / 26 + 0.07 * q.y / 5) + 0.5 * sin_turns(q.x / 13 - q.y / 24);
  return d - 0.9 * band * smooth_step(0.35, 0.6, leaf);
}

double lid(const Vec3d& q) {
  const double r = length2(q.x, q.z - kMiddle);
  const Vec3d turned(r, q.y, 0);
  double d = ellipsoid(turned, {0, 31, 0}, {33, 17, 33});
  d = std::fmax(d, 32.5 - q.y);
  d += 0.6 * bump(r - 22, 1.2);
  const double knob = smooth_min(ellipsoid(turned, {0, 58, 0}, {9, 7.2, 9}), rounded_disc(r, q.y - 49, 4.4, 6, 1), 3);
  return smooth_min(d, knob, 2);
}

double spout(const Vec3d& q) {
  static constexpr std::array<Bead, 5> kSpout = {{{42, -26, 16}, {62, -14, 12.5}, {73, 6, 9}, {81, 26, 7.2}, {90, 37, 6.2}}};
  double d = chain(q, kSpout, 6);
  const double along = (q.x - 88) * 0.45 + (q.y - 38.5) * 0.89;
  d = smooth_max(d, along - 1.5, 1);
  d = std::fmax(d, -(length(q - Vec3d(91, 42, kMiddle + 1)) - 5.2));
  return d;
}

double handle(const Vec3d& q) {
  static constexpr std::array<Bead, 8> kHandle = {
      {{-44, 18, 8}, {-60, 27, 6.5}, {-77, 26, 6}, {-88, 13, 6}, {-88, -5, 6}, {-79, -20, 6}, {-64, -31, 6.3}, {-48, -36, 8}}};
  const double d = chain(q, kHandle, 4);
  const double thumb = ellipsoid(q, {-78, 33, kMiddle}, {8, 4, 5});
  return smooth_min(d, thumb, 3);
}

}  // namespace

double teapot_field(const Vec3d& p) {
  const Vec3d q(p.x, p.y - 2, p.z);
  const double pot = body(q);
  double d = smooth_min(pot, spout(q), 5);
  d = smooth_min(d, handle(q), 3);
  return std::fmin(d, lid(q));
}

}  // namespace etalon::procedural
