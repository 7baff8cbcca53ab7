// The quadric of position and attributes by gradients: the squared distance to the plane of each face, and the squared difference of each
// attribute from the one that the face has at the point below: 11 + 4M coefficients. [Hoppe 1999, sec. 4].
#pragma once

#include "core/simplify/attribute_quadric.h"

namespace etalon::simplify {

/// Q(p, s) = pᵀA p + 2 bᵀp + c + Σ_j (−2 s_j (g_jᵀp + d_j) + w s_j²): sums over faces of weight w of (nᵀp + d)² + Σ_j (g_jᵀp + d_j − s_j)².
/// 23 coefficients for colours (M = 3).
template <class Real, std::size_t M>
struct HoppeQuadric {
  static constexpr std::size_t kAttributes = M;
  Quadric3<Real> space;                    // with the parts of the attributes that position alone decides
  std::array<std::array<Real, 3>, M> g{};  // gradients
  std::array<Real, M> d{};
  Real w = 0;
};

static_assert(sizeof(HoppeQuadric<float, 3>) == 92);

/// Adds a face with a corner at the origin, whose sides from there are side1 and side2. The gradient of an attribute lies in the face and
/// gives its differences along both sides (Hoppe's system 4 in closed form). A face whose height is within the rounding of float32
/// corners (2^-24 of its sides) has no gradient and adds nothing.
template <std::size_t M>
void add_triangle_at_origin(HoppeQuadric<double, M>& q, const AttributeStep<M>& side1, const AttributeStep<M>& side2, double weight) {
  const Vec3d e1 = side1.position(), e2 = side2.position(), n = cross_product(e1, e2);
  const double n2 = dot_product(n, n);
  if (!(n2 > 0x1p-48 * (dot_product(e1, e1) * dot_product(e2, e2)))) return;
  const double length = std::sqrt(n2);
  add_plane_at_origin(q.space, {n.x / length, n.y / length, n.z / length}, weight);
  const Vec3d across2 = cross_product(e2, n), across1 = cross_product(n, e1);
  for (std::size_t j = 0; j < M; ++j) {
    const double s1 = side1.x[3 + j] / n2, s2 = side2.x[3 + j] / n2;
    const Vec3d g{across2.x * s1 + across1.x * s2, across2.y * s1 + across1.y * s2, across2.z * s1 + across1.z * s2};
    add_plane_at_origin(q.space, g, weight);
    q.g[j][0] += weight * g.x;
    q.g[j][1] += weight * g.y;
    q.g[j][2] += weight * g.z;
  }
  q.w += weight;
}

template <std::size_t M>
void add_plane_at_origin(HoppeQuadric<double, M>& q, const Vec3d& normal, double weight) {
  add_plane_at_origin(q.space, normal, weight);
}

/// Q(p, s) in double.
template <class Real, std::size_t M>
double evaluate(const HoppeQuadric<Real, M>& q, const AttributeStep<M>& step) {
  const Vec3d p = step.position();
  double sum = evaluate(q.space, p);
  for (std::size_t j = 0; j < M; ++j) {
    const double s = step.x[3 + j];
    sum += s * (q.w * s - 2.0 * (q.g[j][0] * p.x + q.g[j][1] * p.y + q.g[j][2] * p.z + q.d[j]));
  }
  return sum;
}

/// a plus b as it is measured from the point at `step`.
template <class Real, class Other, std::size_t M>
HoppeQuadric<double, M> moved_sum(const HoppeQuadric<Real, M>& a, const HoppeQuadric<Other, M>& b, const AttributeStep<M>& step) {
  const Vec3d p = step.position();
  HoppeQuadric<double, M> result;
  Quadric3<double> space = moved(b.space, p);
  space.c = evaluate(b, step);
  for (std::size_t j = 0; j < M; ++j) {
    const double s = step.x[3 + j];
    space.x -= s * b.g[j][0];
    space.y -= s * b.g[j][1];
    space.z -= s * b.g[j][2];
    for (std::size_t k = 0; k < 3; ++k) result.g[j][k] = static_cast<double>(a.g[j][k]) + b.g[j][k];
    result.d[j] = a.d[j] + (b.d[j] + (b.g[j][0] * p.x + b.g[j][1] * p.y + b.g[j][2] * p.z) - static_cast<double>(b.w) * s);
  }
  result.space = sum(a.space, space);
  result.w = static_cast<double>(a.w) + b.w;
  return result;
}

/// Each coefficient rounded once.
template <std::size_t M>
HoppeQuadric<float, M> rounded(const HoppeQuadric<double, M>& q) {
  HoppeQuadric<float, M> result;
  result.space = rounded(q.space);
  for (std::size_t j = 0; j < M; ++j) {
    for (std::size_t k = 0; k < 3; ++k) result.g[j][k] = static_cast<float>(q.g[j][k]);
    result.d[j] = static_cast<float>(q.d[j]);
  }
  result.w = static_cast<float>(q.w);
  return result;
}

/// The weights of all faces added.
template <class Real, std::size_t M>
double total_weight(const HoppeQuadric<Real, M>& q) {
  return q.w;
}

/// As of AttributeQuadric: each attribute's best value is (gᵀp + d) / w. False where w is at most `least`.
template <std::size_t M>
bool eliminate_attributes(HoppeQuadric<double, M>& q, double least) {
  if (!(q.w > least)) return false;
  for (std::size_t j = 0; j < M; ++j) {
    const double x = q.g[j][0] / q.w, y = q.g[j][1] / q.w, z = q.g[j][2] / q.w;
    q.space.xx -= x * q.g[j][0];
    q.space.xy -= x * q.g[j][1];
    q.space.xz -= x * q.g[j][2];
    q.space.yy -= y * q.g[j][1];
    q.space.yz -= y * q.g[j][2];
    q.space.zz -= z * q.g[j][2];
    q.space.x -= x * q.d[j];
    q.space.y -= y * q.d[j];
    q.space.z -= z * q.d[j];
    q.space.c -= q.d[j] * q.d[j] / q.w;
  }
  return true;
}

template <std::size_t M>
Quadric3<double> position_part(const HoppeQuadric<double, M>& q) {
  return q.space;
}

template <std::size_t M>
std::array<double, M> best_attributes(const HoppeQuadric<double, M>& q, const Vec3d& d) {
  std::array<double, M> result{};
  for (std::size_t j = 0; j < M; ++j) result[j] = (q.g[j][0] * d.x + q.g[j][1] * d.y + q.g[j][2] * d.z + q.d[j]) / q.w;
  return result;
}

}  // namespace etalon::simplify
