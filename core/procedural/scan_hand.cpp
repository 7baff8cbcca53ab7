// A right hand seen from its back, the thumb aside, two fingers crossed: the jump in depth between them.
#include "core/procedural/scan_shapes.h"

#include <array>

namespace etalon::procedural {

namespace {

/// Knuckle, two joints and tip, in the order of the finger; radii there.
struct Finger {
  std::array<Vec3d, 4> at;
  std::array<double, 4> radius;
};

constexpr double kBase = 6;

const std::array<Finger, 5>& fingers() {
  static const std::array<Finger, 5> kFingers = {{
      {{{{-26, -34, 24}, {-47, -8, 24}, {-60, 14, 21}, {-66, 32, 18}}}, {15, 11.5, 10, 7.6}},   // thumb
      {{{{-23, 14, 30}, {-27, 46, 34}, {-25, 68, 30}, {-22, 83, 25}}}, {10.5, 9.2, 8.2, 6.6}},  // index
      {{{{-4, 19, 32}, {-6, 54, 41}, {-13, 77, 43}, {-19, 92, 40}}}, {10.8, 9.4, 8.4, 6.8}},    // middle, crossing over the index
      {{{{14, 14, 30}, {22, 46, 33}, {26, 67, 28}, {28, 82, 22}}}, {10.2, 8.9, 7.9, 6.4}},      // ring
      {{{{30, 3, 26}, {44, 27, 27}, {51, 43, 22}, {55, 55, 17}}}, {9.2, 7.8, 6.9, 5.6}},        // little
  }};
  return kFingers;
}

double finger(const Vec3d& q, const Finger& f) {
  double d = round_cone(q, f.at[0], f.at[1], f.radius[0], f.radius[1]);
  for (std::size_t k = 1; k < 3; ++k) d = smooth_min(d, round_cone(q, f.at[k], f.at[k + 1], f.radius[k], f.radius[k + 1]), 3);
  for (std::size_t k = 1; k < 3; ++k) {
    const Vec3d way = normalized(f.at[k + 1] - f.at[k - 1]);
    const Vec3d from = q - f.at[k];
    const double along = dot(from, way);
    // A joint is thicker, with three folds of skin over it.
    d -= 0.6 * bump(along, 11);
    for (int fold = -1; fold <= 1; ++fold)
      d += (0.32 - 0.1 * fold * fold) * bump(along - 2.5 * fold + 0.12 * q.x, 1.5) * smooth_step(2, 7, from.z);
  }
  // The nail: a plate a little above the skin with a rim behind it.
  const Vec3d way = normalized(f.at[3] - f.at[2]);
  const Vec3d from = q - f.at[3];
  const Vec3d side = normalized(cross(way, Vec3d(0, 0, 1)));
  const double along = dot(from, way) + 1.5, across = dot(from, side), r = f.radius[3];
  const double outline = length2(along / (1.15 * r), across / (0.78 * r)) - 1;
  return d - smooth_step(0, 1, from.z / r) * (0.45 * smooth_step(0.06, -0.06, outline) - 0.55 * bump(outline - 0.12, 0.16));
}

double palm(const Vec3d& q) {
  double d = ellipsoid(q, {1, -22, 24}, {37, 48, 16});
  d = smooth_min(d, ellipsoid(q, {-20, -34, 20}, {21, 30, 14}), 12);  // the thumb's ball
  d = smooth_min(d, ellipsoid(q, {24, -36, 21}, {16, 32, 13}), 12);
  d = smooth_min(d, round_cone(Vec3d(q.x, q.y, (q.z - 23) * 1.35 + 23), {0, -64, 23}, {2, -120, 23}, 25, 26), 16);  // wrist
  d = smooth_min(d, ellipsoid(q, {21, -80, 33}, {7, 9, 7}), 7);                                                     // the ulna's head
  // Tendons from the wrist to the knuckles, and two veins across them.
  for (std::size_t k = 1; k < 5; ++k) {
    const Vec3d& knuckle = fingers()[k].at[0];
    d = smooth_min(d, round_cone(q, {0.30 * knuckle.x, -58, 34}, knuckle + Vec3d(0, -3, 4.5), 2.4, 4.6), 6);
  }
  const double vein = 10 - 0.10 * q.y + 2.6 * sin_turns(q.y / 41 + 0.1);
  d -= 0.6 * bump(q.x - vein, 3.2) * smooth_step(-72, -58, q.y) * smooth_step(8, -8, q.y) * smooth_step(26, 32, q.z);
  return d - 0.5 * bump(q.x + 7 - 0.28 * q.y - 1.8 * sin_turns(q.y / 33), 2.8) * smooth_step(-66, -52, q.y) * smooth_step(2, -12, q.y) *
                 smooth_step(26, 32, q.z);
}

}  // namespace

double hand_field(const Vec3d& p) {
  const Vec3d q(p.x, p.y, p.z - kBase + 4);
  const double body = palm(q);
  // Fingers melt into the hand at their knuckles only; among each other they stay apart.
  double d = body;
  for (const Finger& f : fingers()) {
    const double one = finger(q, f);
    d = std::fmin(d, smooth_min(one, body, mix(9, 1.5, clamp01(length(q - f.at[0]) / 40))));
  }
  const double cuff = std::fmax(length2(q.x - 2, (q.z - 24) * 1.25) - 30, std::fabs(q.y + 90) - 9);
  return std::fmin(std::fmax(d, -99 - q.y), cuff);
}

}  // namespace etalon::procedural
