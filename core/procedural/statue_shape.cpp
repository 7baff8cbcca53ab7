#include "core/procedural/statue_shape.h"

#include <cmath>

#include "core/procedural/noise.h"

namespace etalon::procedural {

namespace {

const Vec3d kHead(0, 2.98, 0.10);

/// cos and sin of n times the angle of the unit vector (c, s).
Vec2d multiple(double c, double s, int n) {
  Vec2d power(1, 0);
  for (int i = 0; i < n; ++i) power = {power.x * c - power.y * s, power.x * s + power.y * c};
  return power;
}

/// A box with rounded edges.
double box(const Vec3d& p, const Vec3d& center, const Vec3d& half, double round) {
  const Vec3d d(std::fabs(p.x - center.x) - half.x + round, std::fabs(p.y - center.y) - half.y + round,
                std::fabs(p.z - center.z) - half.z + round);
  const Vec3d out(std::fmax(d.x, 0), std::fmax(d.y, 0), std::fmax(d.z, 0));
  return length(out) + std::fmin(std::fmax(d.x, std::fmax(d.y, d.z)), 0) - round;
}

double plinth(const Vec3d& p) {
  double d = box(p, {0, -0.62, 0}, {0.92, 0.10, 0.80}, 0.03);
  d = smooth_min(d, box(p, {0, -0.46, 0}, {0.82, 0.10, 0.70}, 0.05), 0.05);
  d = std::fmin(d, box(p, {0, -0.26, 0}, {0.72, 0.26, 0.60}, 0.02));
  d = smooth_min(d, box(p, {0, -0.04, 0}, {0.84, 0.065, 0.72}, 0.04), 0.05);
  return d;
}

/// Folds that fall from the waist: the wave's phase drifts and its height grows downward.
double folds(const Vec3d& p, double reach) {
  const double r = std::sqrt(p.x * p.x + p.z * p.z) + 1e-9, c = p.z / r, s = p.x / r;
  const double drift = 0.35 * value_noise(Vec3d(c * 1.6, p.y * 0.8, s * 1.6), 4);
  const Vec2d a = multiple(c, s, 13), b = multiple(c, s, 8);
  const double first = a.x * cos_turns(drift) - a.y * sin_turns(drift);
  const double second = b.x * cos_turns(drift * 1.7 + 0.2) + b.y * sin_turns(drift * 1.7 + 0.2);
  const double wave = 0.62 * first + 0.5 * second;
  return reach * (wave > 0 ? wave : 0.55 * wave);  // round ridges, shallow valleys
}

double robe(const Vec3d& p) {
  const Vec3d q(std::fabs(p.x), p.y, p.z);
  const Vec3d flat(q.x, q.y, q.z * 1.22);
  double d = round_cone(flat, {0, 0.30, 0}, {0, 1.55, 0}, 0.56, 0.36);
  d = smooth_min(d, round_cone(flat, {0, 1.5, 0}, {0, 2.20, 0.0}, 0.35, 0.33), 0.20);
  d = smooth_min(d, round_cone(q, {0.0, 2.38, -0.01}, {0.30, 2.27, 0.0}, 0.17, 0.17), 0.14);  // shoulders
  d = smooth_min(d, round_cone(flat, {0, 0.10, 0}, {0, 0.35, 0}, 0.68, 0.55), 0.15);          // flare at the ground
  d -= folds(p, 0.055 * smooth_step(2.0, 0.2, p.y));
  d = smooth_max(d, 0.015 - p.y, 0.04);
  // Sleeves: wide, the cloth hangs below the joined hands.
  double sleeve = round_cone(q, {0.40, 2.20, 0.0}, {0.50, 1.72, 0.10}, 0.16, 0.19);
  sleeve = smooth_min(sleeve, round_cone(q, {0.50, 1.72, 0.12}, {0.14, 1.82, 0.50}, 0.19, 0.13), 0.10);
  const double hang = 0.030 * cos_turns(2.1 * q.x / 0.35 + 0.8 * q.z) * smooth_step(1.80, 1.30, p.y);
  sleeve = smooth_min(sleeve, round_cone(q, {0.28, 1.60, 0.32}, {0.26, 1.02, 0.34}, 0.17, 0.11) + hang, 0.12);
  d = smooth_min(d, sleeve, 0.07);
  // Nothing is hollow between arms and body: a cast would have been filled there, and the surface stays a sphere.
  d = smooth_min(d, round_cone(q, {0.0, 1.78, 0.22}, {0.36, 1.78, 0.08}, 0.25, 0.20), 0.08);
  return smooth_min(d, round_cone(q, {0.10, 1.62, 0.22}, {0.18, 1.02, 0.24}, 0.22, 0.16), 0.06);
}

double veil(const Vec3d& p) {
  const Vec3d q(std::fabs(p.x), p.y, p.z);
  // Over the head and down the back; open in front.
  double d = ellipsoid(q, {0, 3.05, -0.02}, {0.335, 0.395, 0.36});
  d = smooth_min(d, round_cone(q, {0, 2.85, -0.10}, {0, 2.30, -0.16}, 0.28, 0.37), 0.18);
  d = smooth_min(d, round_cone(Vec3d(q.x * 0.92, q.y, q.z), {0, 2.30, -0.13}, {0, 0.75, -0.30}, 0.36, 0.34), 0.20);
  d = smooth_min(d, round_cone(q, {0.22, 2.46, 0.02}, {0.40, 1.95, -0.06}, 0.16, 0.15), 0.12);  // over the shoulders
  d -= folds(p - Vec3d(0, 0, 0.15), 0.030 * smooth_step(3.0, 1.4, p.y));
  d = smooth_max(d, 0.62 - p.y - 0.10 * cos_turns(1.2 * p.x), 0.05);
  // The opening: an arch in front of the face, widening over the chest.
  const double arch = length(Vec3d(q.x / 0.235, (p.y - 2.99) / 0.335, 0)) - 1;
  const double chest = q.x - mix(0.22, 0.40, smooth_step(2.75, 1.9, p.y));
  const double opening = p.y > 2.99 ? 0.235 * arch : std::fmin(0.235 * arch, smooth_max(chest, p.y - 2.99, 0.02));
  const double front = smooth_max(opening, 0.02 - p.z, 0.04);  // negative: cut away
  return smooth_max(d, -front, 0.04);
}

double head(const Vec3d& p) {
  const Vec3d q(std::fabs(p.x), p.y, p.z), c = kHead;
  double d = ellipsoid(q, c + Vec3d(0, 0.06, -0.03), {0.215, 0.25, 0.235});
  d = smooth_min(d, ellipsoid(q, c + Vec3d(0, -0.11, 0.05), {0.155, 0.19, 0.16}), 0.10);                          // jaw
  d = smooth_min(d, ellipsoid(q, c + Vec3d(0, -0.265, 0.135), {0.052, 0.040, 0.045}), 0.05);                      // chin
  d = smooth_min(d, ellipsoid(q, c + Vec3d(0.085, -0.06, 0.13), {0.075, 0.065, 0.06}), 0.06);                     // cheek
  d = smooth_min(d, round_cone(q, c + Vec3d(0, 0.055, 0.205), c + Vec3d(0, -0.058, 0.258), 0.018, 0.028), 0.03);  // nose
  d = smooth_min(d, ellipsoid(q, c + Vec3d(0.026, -0.070, 0.232), {0.022, 0.018, 0.022}), 0.02);
  d = smooth_min(d, round_cone(q, c + Vec3d(0.02, 0.078, 0.196), c + Vec3d(0.125, 0.074, 0.150), 0.018, 0.016), 0.035);  // brow
  d = smooth_max(d, 0.046 - length((q - c - Vec3d(0.080, 0.032, 0.232)) * Vec3d(0.8, 1.15, 1)), 0.05);                   // sockets
  d = smooth_min(d, ellipsoid(q, c + Vec3d(0.078, 0.022, 0.150), {0.046, 0.036, 0.040}), 0.012);                         // closed lids
  d += 0.006 * bump(q.y - c.y - 0.012 + 0.10 * (q.x - 0.078) * (q.x - 0.078) * 20, 0.010) * bump(q.x - 0.078, 0.055);
  d = smooth_min(d, ellipsoid(q, c + Vec3d(0, -0.147, 0.184), {0.048, 0.024, 0.030}), 0.014);      // solid behind the lips
  d = smooth_min(d, ellipsoid(q, c + Vec3d(0.016, -0.134, 0.204), {0.036, 0.014, 0.022}), 0.016);  // lips
  d = smooth_min(d, ellipsoid(q, c + Vec3d(0, -0.160, 0.196), {0.040, 0.016, 0.022}), 0.014);
  d += 0.008 * bump(q.y - c.y + 0.146 - 0.25 * q.x * q.x, 0.010) * bump(q.x, 0.062);
  d = smooth_min(d, round_cone(q, {0, 2.80, 0.04}, {0, 2.42, 0.0}, 0.115, 0.15), 0.06);  // neck
  return d;
}

double hair(const Vec3d& p) {
  const Vec3d q(std::fabs(p.x), p.y, p.z);
  double d = ellipsoid(q, kHead + Vec3d(0, 0.09, -0.05), {0.262, 0.300, 0.255});
  d += 0.007 * cos_turns(9 * q.x + 3 * (p.y - kHead.y)) - 0.004;
  const double line = 0.215 - 0.9 * q.x;  // parted in the middle
  d = smooth_max(d, kHead.y + line - p.y + 0.35 * (p.z - 0.2), 0.02);
  return smooth_min(d, ellipsoid(q, kHead + Vec3d(0.205, -0.02, -0.045), {0.062, 0.17, 0.105}),
                    0.03);  // locks at the temples, up to the veil
}

double hands(const Vec3d& p) {
  const Vec3d q(std::fabs(p.x), p.y, p.z);
  double d = round_cone(q, {0.045, 1.80, 0.53}, {0.022, 2.08, 0.63}, 0.062, 0.032);
  d = smooth_min(d, round_cone(q, {0.16, 1.80, 0.44}, {0.05, 1.82, 0.55}, 0.085, 0.06), 0.05);
  d = smooth_min(d, round_cone(q, {0.0, 1.80, 0.50}, {0.0, 1.95, 0.55}, 0.05, 0.035), 0.02);         // no gap between the palms
  return smooth_min(d, round_cone(q, {0.05, 1.86, 0.50}, {0.030, 1.98, 0.53}, 0.030, 0.022), 0.02);  // thumb
}

}  // namespace

double statue_field(const Vec3d& p) {
  double d = plinth(p);
  if (p.y < -0.3) return d;
  d = smooth_min(d, robe(p), 0.03);
  if (p.y > 0.3) d = smooth_min(d, veil(p), 0.025);
  if (p.y > 2.2) d = smooth_min(smooth_min(d, head(p), 0.02), hair(p), 0.012);
  if (p.y > 1.5 && p.y < 2.4) d = smooth_min(d, hands(p), 0.02);
  return d;
}

StatuePart statue_part(const Vec3d& p) {
  const double parts[5] = {plinth(p), robe(p), veil(p), std::fmin(head(p), hands(p)), hair(p)};
  int best = 0;
  for (int i = 1; i < 5; ++i)
    if (parts[i] < parts[best]) best = i;
  return static_cast<StatuePart>(best);
}

double statue_border(const Vec3d& p, StatuePart part) {
  const double ax = std::fabs(p.x);
  if (part == StatuePart::robe) {
    const double cuff = length(Vec3d(ax - 0.13, p.y - 1.82, p.z - 0.52)) - 0.165;
    const double collar = std::fabs(ax - 0.40 * (2.48 - p.y) - 0.02) + (p.z < 0.1 || p.y < 1.95 ? 1 : 0);
    return std::fmin(std::fmin(std::fabs(p.y - 0.16), std::fabs(cuff)), collar);
  }
  if (part == StatuePart::veil) {
    const double hem = std::fabs(p.y - 0.74 + 0.10 * cos_turns(1.2 * p.x));
    const double arch = 0.29 * std::fabs(length(Vec3d(ax / 0.285, (p.y - 2.99) / 0.385, 0)) - 1) + (p.y < 2.80 || p.z < 0 ? 1 : 0);
    const double edge = std::fabs(ax - mix(0.25, 0.43, smooth_step(2.75, 1.9, p.y))) + (p.y > 2.80 || p.z < -0.15 ? 1 : 0);
    return std::fmin(hem, std::fmin(arch, edge));
  }
  return 1;
}

}  // namespace etalon::procedural
