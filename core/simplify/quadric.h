// The quadric of a point in space: a weighted sum of squared distances to planes, in 10 coefficients.
// [Garland & Heckbert 1997]; [Kim, Choi & Lee 2008, eqs. 1-9].
#pragma once

#include "core/math/vec.h"

namespace etalon::simplify {

/// Q(d) = dᵀA d + 2 bᵀd + c (eqs. 3-6), d measured from a point that is agreed on elsewhere; A symmetric, in the order xx xy xz yy yz zz.
/// Real is float where states are stored, double where they are computed.
template <class Real>
struct Quadric3 {
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

/// The weight of all planes added: the trace of A, since normals have length 1.
template <class Real>
double total_weight(const Quadric3<Real>& q) {
  return static_cast<double>(q.xx) + q.yy + q.zz;
}

}  // namespace etalon::simplify
