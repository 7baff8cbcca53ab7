// The quadric of a point with attributes: a weighted sum of squared distances to the planes of triangles in a space of 3 + M dimensions.
// [Garland & Heckbert 1998, sec. 3]; [Kim, Choi & Lee 2008, eqs. 10-12].
#pragma once

#include <cmath>

#include "core/simplify/quadric.h"

namespace etalon::simplify {

/// Q(x) = xᵀA x + 2 bᵀx + c (eq. 12), x measured from the point agreed on: 28 coefficients for colours (M = 3), 21 for texture coordinates
/// (M = 2).
template <class Real, std::size_t M>
struct AttributeQuadric {
  static constexpr std::size_t kAttributes = M, kSize = 3 + M;
  std::array<Real, kSize*(kSize + 1) / 2> a{};  // the upper triangle, row by row
  std::array<Real, kSize> b{};
  Real c = 0;

  /// Index into a of the entry in row i, column j, i ≤ j.
  static constexpr std::size_t at(std::size_t i, std::size_t j) { return i * kSize - i * (i + 1) / 2 + j; }
};

static_assert(sizeof(AttributeQuadric<float, 3>) == 112);

/// Adds weight · (squared distance to the plane through the origin that e1 and e2 span): A = I − e1 e1ᵀ − e2 e2ᵀ of the orthonormalised
/// sides
/// (eqs. 10, 11), b = c = 0. Nothing where they span no plane: where the rounding of float32 corners could have made all of their second
/// direction, 2^-24 of its length.
template <std::size_t M>
void add_triangle_at_origin(AttributeQuadric<double, M>& q, const AttributeStep<M>& side1, const AttributeStep<M>& side2, double weight) {
  constexpr std::size_t n = 3 + M;
  const auto dot = [](const std::array<double, n>& x, const std::array<double, n>& y) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += x[i] * y[i];
    return sum;
  };
  std::array<double, n> e1 = side1.x, e2 = side2.x;
  const double length1 = dot(e1, e1), length2 = dot(e2, e2);
  if (!(length1 > 0)) return;
  const double along = dot(e1, e2) / length1;
  for (std::size_t i = 0; i < n; ++i) e2[i] -= along * e1[i];
  const double rest = dot(e2, e2);
  if (!(rest > 0x1p-48 * length2)) return;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n; ++j) q.a[q.at(i, j)] += weight * ((i == j ? 1.0 : 0.0) - e1[i] * e1[j] / length1 - e2[i] * e2[j] / rest);
}

/// Adds a plane of space alone, through the origin.
template <std::size_t M>
void add_plane_at_origin(AttributeQuadric<double, M>& q, const Vec3d& normal, double weight) {
  const std::array<double, 3> n{normal.x, normal.y, normal.z};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j) q.a[q.at(i, j)] += weight * n[i] * n[j];
}

/// A x.
template <class Real, std::size_t M>
std::array<double, 3 + M> times(const AttributeQuadric<Real, M>& q, const AttributeStep<M>& step) {
  std::array<double, 3 + M> result{};
  for (std::size_t i = 0; i < 3 + M; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < 3 + M; ++j) sum += static_cast<double>(q.a[i <= j ? q.at(i, j) : q.at(j, i)]) * step.x[j];
    result[i] = sum;
  }
  return result;
}

/// Q(x) in double, as x·(A x + 2b) + c.
template <class Real, std::size_t M>
double evaluate(const AttributeQuadric<Real, M>& q, const AttributeStep<M>& step) {
  const std::array<double, 3 + M> ax = times(q, step);
  double sum = 0;
  for (std::size_t i = 0; i < 3 + M; ++i) sum += step.x[i] * (ax[i] + 2.0 * q.b[i]);
  return sum + q.c;
}

/// a plus b as it is measured from the point at `step`: A, A x + b, Q(x).
template <class Real, class Other, std::size_t M>
AttributeQuadric<double, M> moved_sum(const AttributeQuadric<Real, M>& a, const AttributeQuadric<Other, M>& b,
                                      const AttributeStep<M>& step) {
  AttributeQuadric<double, M> result;
  for (std::size_t i = 0; i < a.a.size(); ++i) result.a[i] = static_cast<double>(a.a[i]) + b.a[i];
  const std::array<double, 3 + M> bx = times(b, step);
  for (std::size_t i = 0; i < 3 + M; ++i) result.b[i] = a.b[i] + (bx[i] + b.b[i]);
  result.c = a.c + evaluate(b, step);
  return result;
}

/// Each coefficient rounded once.
template <std::size_t M>
AttributeQuadric<float, M> rounded(const AttributeQuadric<double, M>& q) {
  AttributeQuadric<float, M> result;
  for (std::size_t i = 0; i < q.a.size(); ++i) result.a[i] = static_cast<float>(q.a[i]);
  for (std::size_t i = 0; i < q.b.size(); ++i) result.b[i] = static_cast<float>(q.b[i]);
  result.c = static_cast<float>(q.c);
  return result;
}

/// The weights of all triangles added, and about a third as much of each plane of space: the trace of A is 1 + M of each triangle.
template <class Real, std::size_t M>
double total_weight(const AttributeQuadric<Real, M>& q) {
  double trace = 0;
  for (std::size_t i = 0; i < 3 + M; ++i) trace += q.a[q.at(i, i)];
  return trace / (1 + M);
}

/// Takes the attributes out, each where it makes Q least for a given position (Schur complement, last attribute first): what is left is
/// position_part().
/// False where Q leaves an attribute open: a pivot of at most `least`.
template <std::size_t M>
bool eliminate_attributes(AttributeQuadric<double, M>& q, double least) {
  for (std::size_t k = 2 + M; k >= 3; --k) {
    const double pivot = q.a[q.at(k, k)];
    if (!(pivot > least)) return false;
    for (std::size_t i = 0; i < k; ++i) {
      const double factor = q.a[q.at(i, k)] / pivot;
      for (std::size_t j = i; j < k; ++j) q.a[q.at(i, j)] -= factor * q.a[q.at(j, k)];
      q.b[i] -= factor * q.b[k];
    }
    q.c -= q.b[k] * q.b[k] / pivot;
  }
  return true;
}

/// The quadric of position that eliminate_attributes() leaves.
template <std::size_t M>
Quadric3<double> position_part(const AttributeQuadric<double, M>& q) {
  return {q.a[q.at(0, 0)], q.a[q.at(0, 1)], q.a[q.at(0, 2)], q.a[q.at(1, 1)], q.a[q.at(1, 2)],
          q.a[q.at(2, 2)], q.b[0],          q.b[1],          q.b[2],          q.c};
}

/// The best attributes at a position, of what eliminate_attributes() has gone through.
template <std::size_t M>
std::array<double, M> best_attributes(const AttributeQuadric<double, M>& q, const Vec3d& d) {
  AttributeStep<M> step = step_of<M>(d, {});
  std::array<double, M> result{};
  for (std::size_t k = 3; k < 3 + M; ++k) {
    double sum = q.b[k];
    for (std::size_t j = 0; j < k; ++j) sum += q.a[q.at(j, k)] * step.x[j];
    result[k - 3] = step.x[k] = -sum / q.a[q.at(k, k)];
  }
  return result;
}

}  // namespace etalon::simplify
