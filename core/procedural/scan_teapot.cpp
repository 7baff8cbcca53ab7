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

/// Outline of the flowers in relief around the belly: five petals, a ring about their middle left out; negative inside.
double rosettes(const Vec3d& q) {
  double outline = 1e30;
  for (int k = -1; k <= 1; ++k) {
    const double u = (q.x - 33 * k) * (1 + 0.16 * k * k), v = q.y + 9, r2 = u * u + v * v + 1e-9, r = std::sqrt(r2);
    const double cos5 = v * (v * v * v * v - 10 * v * v * u * u + 5 * u * u * u * u) / (r2 * r2 * r);  // of five times the angle from up
    const double petals = r - 8.6 - 3.4 * cos5;
    outline = std::fmin(outline, std::fmax(petals, 1.1 - std::fabs(r - 3.6)));
  }
  return outline;
}

double body(const Vec3d& q) {
  const double r = length2(q.x, q.z - kMiddle);
  const Vec3d turned(r, q.y, 0);
  double d = ellipsoid(turned, {0, -10, 0}, {56, 42, 56});
  d = smooth_min(d, rounded_disc(r, q.y - 27, 35, 4.4, 1.5), 7);  // rim
  d = smooth_min(d, rounded_disc(r, q.y + 51, 34, 4.5, 1.5), 5);  // foot
  d = std::fmax(d, -54.5 - q.y);
  for (int k = 0; k < 2; ++k) d += 0.8 * bump(q.y - 14 + 46 * k, 1.5) * smooth_step(20, 30, r);  // turned grooves
  return d - 0.8 * smooth_step(0.5, -0.5, rosettes(q)) * smooth_step(0, 10, q.z - kMiddle);
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
  double d = chain(q, kSpout, 1.5);
  const double along = (q.x - 88) * 0.45 + (q.y - 38.5) * 0.89;
  d = smooth_max(d, along - 1.5, 1);
  d = std::fmax(d, -(length(q - Vec3d(91, 42, kMiddle + 1)) - 5.2));
  return d;
}

double handle(const Vec3d& q) {
  // A torus of oval section; what of it is inside the body does not show.
  const double ring = length2((q.x + 60) * 0.96, q.y + 3) - 29;
  const double d = length2(ring, (q.z - kMiddle) * 0.8) - 5.6;
  return smooth_min(d, ellipsoid(q, {-72, 29.5, kMiddle}, {7, 4.2, 5}), 3);
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
