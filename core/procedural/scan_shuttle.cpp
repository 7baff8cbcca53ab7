// A replica of a space shuttle from above, nose up: a fuselage over thin wings, a tall fin, engines.
#include "core/procedural/scan_shapes.h"

#include <array>

namespace etalon::procedural {

namespace {

/// Signed distance to a closed polygon, counter-clockwise or not [Quilez, "polygon"].
template <std::size_t kCount>
double polygon(double x, double y, const std::array<std::array<double, 2>, kCount>& v) {
  double squared = 1e30;
  bool inside = false;
  for (std::size_t i = 0, j = kCount - 1; i < kCount; j = i++) {
    const double ex = v[j][0] - v[i][0], ey = v[j][1] - v[i][1], wx = x - v[i][0], wy = y - v[i][1];
    const double t = clamp01((wx * ex + wy * ey) / (ex * ex + ey * ey));
    const double bx = wx - ex * t, by = wy - ey * t;
    squared = std::fmin(squared, bx * bx + by * by);
    if ((v[i][1] > y) != (v[j][1] > y) && x < ex * (y - v[i][1]) / ey + v[i][0]) inside = !inside;
  }
  return inside ? -std::sqrt(squared) : std::sqrt(squared);
}

/// A slab of the given outline with rounded rim; `above` is the height over its middle plane.
double slab(double outline, double above, double half_height, double radius) {
  const double x = outline + radius, y = std::fabs(above) - half_height + radius;
  const double ox = std::fmax(x, 0), oy = std::fmax(y, 0);
  return std::sqrt(ox * ox + oy * oy) + std::fmin(std::fmax(x, y), 0) - radius;
}

constexpr double kAxis = 28;  ///< height of the fuselage's middle

double fuselage(const Vec3d& q) {
  // Flat below, round above; a drooping nose.
  double d = round_cone(q, {0, -62, kAxis}, {0, 52, kAxis}, 17.5, 16);
  d = smooth_max(d, -(q.z - kAxis + 14), 4);
  d = smooth_min(d, ellipsoid(q, {0, 58, kAxis - 3}, {14.5, 36, 13.5}), 12);
  const double doors = std::fabs(q.y + 6) - 42;  // the bay's doors: a shell a little proud, split along the back
  d -= 0.9 * smooth_step(0.8, -0.8, doors) * smooth_step(-2, 1, q.z - kAxis);
  d += 0.7 * bump(q.x, 1.3) * smooth_step(1, -1, doors) * smooth_step(0, 6, q.z - kAxis);
  for (int k = -1; k <= 1; ++k) d += 0.35 * bump(q.y + 6 - 21 * k, 1.2) * smooth_step(0, 6, q.z - kAxis);
  return d;
}

double cabin(const Vec3d& q) {
  double d = ellipsoid(q, {0, 53, kAxis + 7}, {12.5, 17, 12.5});
  // Six windows, sunk into the front.
  const double front = dot(q - Vec3d(0, 66, kAxis + 13), Vec3d(0, 0.7071, 0.7071));
  for (int k = 0; k < 3; ++k) {
    const double x = 2.2 + 3.7 * k, y = 66.5 - 0.9 * k * k;
    const double pane = std::fmax(std::fabs(std::fabs(q.x) - x) - 1.4, std::fabs(q.y - y) - 1.7);
    d += 0.8 * smooth_step(0.5, -0.4, pane) * smooth_step(-8, -4, front);
  }
  return d;
}

double wings(const Vec3d& q) {
  static constexpr std::array<std::array<double, 2>, 8> kPlan = {
      {{0, 46}, {14, 40}, {27, -6}, {66, -52}, {69, -66}, {40, -74}, {14, -76}, {0, -76}}};
  const double x = std::fabs(q.x), outline = polygon(x, q.y, kPlan);
  const double thick = mix(5.2, 1.6, clamp01(x / 66)), height = 13 + 0.10 * x;
  double d = slab(outline, q.z - height, thick, 1.4) * 0.9;
  d += 0.6 * bump(q.y + 62, 1.2) * smooth_step(16, 19, x);  // elevons
  return d + 0.6 * bump(x - 44, 1.2) * smooth_step(-60, -64, q.y);
}

double tail(const Vec3d& q) {
  // The fin leans back: from above a ridge that rises toward the rear.
  const double up = (q.z - kAxis - 12) / 42;
  const double lead = -48 - 34 * up, trail = -80 - 16 * up;
  const double along = std::fmax(q.y - lead, trail - q.y) * 0.75;
  const double half = mix(4.0, 1.7, clamp01(up));
  double fin = std::fmax(along, std::fmax(std::fabs(q.x) - half * smooth_step(lead + 1, lead - 11, q.y) - 0.3, q.z - kAxis - 52)) * 0.7;
  fin = std::fmax(fin, kAxis - q.z);
  const Vec3d p(std::fabs(q.x), q.y, q.z);
  double pods = round_cone(p, {12.5, -76, kAxis + 11}, {9.5, -50, kAxis + 8}, 9.2, 4.5);
  pods = smooth_max(pods, -80 - q.y, 2);
  const double top = round_cone(p, {0, -79, kAxis + 9}, {0, -91, kAxis + 10.5}, 5, 7.6);
  const double low = round_cone(p, {10, -78, kAxis - 5}, {11, -90, kAxis - 5}, 5, 7.6);
  const double nozzles = smooth_max(std::fmin(top, low), -92 - q.y, 0.6);
  const double cups =
      std::fmax(nozzles, -std::fmin(length(p - Vec3d(0, -96, kAxis + 10.5)) - 9, length(p - Vec3d(11, -95, kAxis - 5)) - 9));
  return std::fmin(std::fmin(fin, pods), cups);
}

}  // namespace

double shuttle_field(const Vec3d& p) {
  const Vec3d q(p.x, p.y, p.z);
  double d = smooth_min(fuselage(q), cabin(q), 5);
  d = smooth_min(d, wings(q), 3);
  return smooth_min(d, tail(q), 1.5);
}

}  // namespace etalon::procedural
