// A telephone with a dial: a wedge with its handset across, which leaves jumps in depth to the body and to nothing.
#include "core/procedural/scan_shapes.h"

namespace etalon::procedural {

namespace {

constexpr double kSlope = 0.24;  ///< of the front, height per length
constexpr double kDialY = -26;

/// Height of the sloped front at y.
double front_at(double y) { return 34 + kSlope * (y + 84); }

double body(const Vec3d& q) {
  // Narrower toward the back, with a sloped front and a flat top under the handset.
  const double narrow = mix(70, 58, clamp01((q.y + 86) / 150));
  double d = rounded_box(q, {0, -10, 30}, {narrow, 76, 62}, 14);
  d = smooth_max(d, (q.z - front_at(q.y)) / std::sqrt(1 + kSlope * kSlope), 8);
  d = smooth_max(d, q.z - 61, 5);
  d = std::fmax(d, -rounded_box(q, {0, 86, 10}, {30, 26, 22}, 5));                            // where the line goes in
  return smooth_min(d, rounded_box(q, {0, -70, front_at(-70) - 1}, {18, 5, 3.2}, 1.2), 0.6);  // a label below the dial
}

/// Ten finger holes in a disc that lies on the sloped front, a card in its middle, a stop.
double dial(const Vec3d& q) {
  const double norm = 1 / std::sqrt(1 + kSlope * kSlope);
  const Vec3d c(0, kDialY, front_at(kDialY));
  const double along = (q.y - c.y) * norm + (q.z - c.z) * norm * kSlope;  // up the front
  const double above = (q.z - c.z) * norm - (q.y - c.y) * norm * kSlope;  // off it
  const double from_axis = length2(q.x, along);
  double ring = rounded_disc(from_axis, above, 50, 2.2, 1);  // numbers' ring
  double plate = rounded_disc(from_axis, above - 3.5, 43, 4.2, 1.6);
  for (int k = 0; k < 10; ++k) {
    const double turn = 0.085 + 0.083 * k;
    const double hole = length2(q.x - 32.5 * cos_turns(turn), along - 32.5 * sin_turns(turn)) - 6.6;
    plate = smooth_max(plate, -hole, 1.2);
  }
  plate = smooth_max(plate, -rounded_disc(from_axis, above - 8.4, 20, 1.5, 0.6), 0.5);
  plate = std::fmin(plate, ellipsoid(Vec3d(q.x, along, above), {0, 0, 4.5}, {17, 17, 4.2}));
  const double stop = round_cone(Vec3d(q.x, along, above), {26, -42, 8}, {46, -33, 3}, 2.2, 3.2);
  ring = smooth_min(ring, stop, 1.5);
  return std::fmin(ring, plate);
}

double cradle(const Vec3d& q) {
  const Vec3d p(std::fabs(q.x), q.y, q.z);
  const double back = round_cone(p, {44, 66, 58}, {44, 69, 72}, 7, 3.8), front = round_cone(p, {44, 26, 58}, {44, 23, 70}, 7, 3.8);
  return std::fmin(back, front);
}

double handset(const Vec3d& q) {
  constexpr double kY = 46;
  const Vec3d p(std::fabs(q.x), q.y - kY, q.z);
  // Cups that look down and a grip that bends over them.
  const Vec3d cup_axis(0.18, 0, -0.983666);
  const Vec3d from_cup = p - Vec3d(74, 0, 66);
  const double down = dot(from_cup, cup_axis);
  double cup = rounded_disc(length(from_cup - cup_axis * down), down, mix(22.5, 19, clamp01(down / 20 + 0.5)), 11, 5);
  cup = smooth_min(cup, ellipsoid(p, {72, 0, 72}, {20, 19, 13}), 5);
  const double bend = p.x / 74;
  const Vec3d along(p.x, p.y, p.z - 94 + 17 * bend * bend);
  double grip = rounded_box(along, {0, 0, 0}, {72, 12.5, 9}, 6) * 0.85;
  grip = smooth_max(grip, (std::fabs(p.y) * 0.62 + (along.z)) * 0.8 - 8.3, 1.5);  // its bevels
  grip = smooth_max(grip, -(length2(p.y, along.z - 10.5) - 3.0), 0.8);            // a groove along its back
  return smooth_min(grip, cup, 9);
}

double cord(const Vec3d& q) {
  const double t = clamp01((q.y + 78) / 108);
  const double x = -85 - 4 * sin_turns(1.5 * t + 0.1) + 8 * (1 - t) * (1 - t);
  const double z = mix(5, 46, t * t);
  const double tube = length2(q.x - x, q.z - z) - 3 - 0.6 * sin_turns(q.y / 9);
  return std::fmax(tube * 0.75, std::fabs(q.y + 24) - 54);
}

}  // namespace

double telephone_field(const Vec3d& p) {
  const Vec3d q(p.x, p.y + 8, p.z);
  double d = smooth_min(body(q), cradle(q), 3);
  d = std::fmin(d, dial(q));
  d = std::fmin(d, handset(q));
  return std::fmin(d, cord(q));
}

}  // namespace etalon::procedural
