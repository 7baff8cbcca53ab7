// The quadric of a point in space: a weighted sum of squared distances to planes, in 10 coefficients.
// [Garland & Heckbert 1997]; [Kim, Choi & Lee 2008, eqs. 1-9].
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/math/nearest_point.h"

namespace etalon::simplify {

/// A step in space and attributes.
template <std::size_t M>
struct AttributeStep {
  std::array<double, 3 + M> x{};
  [[nodiscard]] Vec3d position() const { return {x[0], x[1], x[2]}; }
};

template <std::size_t M>
AttributeStep<M> step_of(const Vec3d& d, const std::array<double, M>& attributes) {
  AttributeStep<M> step;
  step.x[0] = d.x;
  step.x[1] = d.y;
  step.x[2] = d.z;
  for (std::size_t j = 0; j < M; ++j) step.x[3 + j] = attributes[j];
  return step;
}

/// Q(d) = dᵀA d + 2 bᵀd + c (eqs. 3-6), d measured from a point that is agreed on elsewhere; A symmetric, in the order xx xy xz yy yz zz.
/// Real is float where states are stored, double where they are computed.
template <class Real>
struct Quadric3 {
  static constexpr std::size_t kAttributes = 0;
  Real xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  Real x = 0, y = 0, z = 0;
  Real c = 0;
};

static_assert(sizeof(Quadric3<float>) == 40);

/// Adds weight · (squared distance to the plane through the origin of d with that unit normal): A += weight·n nᵀ, b = c = 0.
inline void add_plane_at_origin(Quadric3<double>& q, const Vec3d& normal, double weight) {
  const double wx = weight * normal.x, wy = weight * normal.y, wz = weight * normal.z;
  q.xx += wx * normal.x;
  q.xy += wx * normal.y;
  q.xz += wx * normal.z;
  q.yy += wy * normal.y;
  q.yz += wy * normal.z;
  q.zz += wz * normal.z;
}

/// Q(d) in double (eq. 6), evaluated as d·(A d + 2b) + c.
template <class Real>
double evaluate(const Quadric3<Real>& q, const Vec3d& d) {
  const double gx = q.xx * d.x + q.xy * d.y + q.xz * d.z + 2.0 * q.x;
  const double gy = q.xy * d.x + q.yy * d.y + q.yz * d.z + 2.0 * q.y;
  const double gz = q.xz * d.x + q.yz * d.y + q.zz * d.z + 2.0 * q.z;
  return d.x * gx + d.y * gy + d.z * gz + q.c;
}

/// The same quadric measured from the point at d: A, A d + b, Q(d).
template <class Real>
Quadric3<double> moved(const Quadric3<Real>& q, const Vec3d& d) {
  return {q.xx,
          q.xy,
          q.xz,
          q.yy,
          q.yz,
          q.zz,
          q.xx * d.x + q.xy * d.y + q.xz * d.z + q.x,
          q.xy * d.x + q.yy * d.y + q.yz * d.z + q.y,
          q.xz * d.x + q.yz * d.y + q.zz * d.z + q.z,
          evaluate(q, d)};
}

/// Component-wise sum (eq. 7), in double.
template <class Real>
Quadric3<double> sum(const Quadric3<Real>& a, const Quadric3<double>& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz, a.x + b.x, a.y + b.y, a.z + b.z, a.c + b.c};
}

/// Each coefficient rounded once.
inline Quadric3<float> rounded(const Quadric3<double>& q) {
  return {static_cast<float>(q.xx), static_cast<float>(q.xy), static_cast<float>(q.xz), static_cast<float>(q.yy), static_cast<float>(q.yz),
          static_cast<float>(q.zz), static_cast<float>(q.x),  static_cast<float>(q.y),  static_cast<float>(q.z),  static_cast<float>(q.c)};
}

/// Pivots below this share of all weights are noise: coefficients are rounded to 2^-24 of them at each collapse, which moves the solution
/// by that over the pivot: by 2^-8 of the step at most.
inline constexpr double kLeastPivot = 0x1p-16;

/// Where Q is least: −A⁻¹b (Kim, Choi & Lee, end of sec. 3.1), by elimination of z, y, x; nothing where a pivot is at most `least`.
inline std::optional<Vec3d> minimum(const Quadric3<double>& q, double least) {
  if (!(q.zz > least)) return std::nullopt;
  const double xz = q.xz / q.zz, yz = q.yz / q.zz;
  const double xx = q.xx - xz * q.xz, xy = q.xy - xz * q.yz, yy = q.yy - yz * q.yz, x = q.x - xz * q.z, y = q.y - yz * q.z;
  if (!(yy > least)) return std::nullopt;
  const double xy_yy = xy / yy, pivot = xx - xy_yy * xy;
  if (!(pivot > least)) return std::nullopt;
  const double dx = -(x - xy_yy * y) / pivot;
  const double dy = -(y + xy * dx) / yy;
  return Vec3d{dx, dy, -(q.z + q.xz * dx + q.yz * dy) / q.zz};
}

// What templates over quadrics with attributes ask of one without.
inline double evaluate(const Quadric3<double>& q, const AttributeStep<0>& step) { return evaluate(q, step.position()); }
inline bool eliminate_attributes(Quadric3<double>&, double) { return true; }
inline Quadric3<double> position_part(const Quadric3<double>& q) { return q; }
inline std::array<double, 0> best_attributes(const Quadric3<double>&, const Vec3d&) { return {}; }

/// The weight of all planes added: the trace of A, since normals have length 1.
template <class Real>
double total_weight(const Quadric3<Real>& q) {
  return static_cast<double>(q.xx) + q.yy + q.zz;
}

}  // namespace etalon::simplify
