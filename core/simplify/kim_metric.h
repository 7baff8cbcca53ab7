// The metric `kim`: the quadric of position, the visual importance of a vertex' colour, and the colour change of a collapse, multiplied.
// [Kim, Choi & Lee 2008, sec. 4].
#pragma once

#include <span>

#include "core/simplify/collapse_candidate.h"
#include "core/simplify/qem_metric.h"

namespace etalon::simplify {

struct KimOptions {
  /// The length in model units that counts as 1; 0: the bounding box diagonal / 8000. Q has the unit length⁴ and C length, so the balance
  /// of
  /// equation 17 depends on it; the default is the scale that the figures of the paper's table 2 suggest.
  double unit = 0;
};

/// State: 12 float32 a vertex, the 10 of QemMetric, the visual importance, and the largest colour distance of equation 14 (stored as in the
/// paper; after a collapse the larger of both; no cost reads it). All arithmetic in double.
class KimMetric {
 public:
  /// Equation 16 sums over the neighbours of u: its costs change whenever its faces do.
  static constexpr bool kCostsAreLocal = false;

  /// InputError where the mesh has no colours or the unit is not a positive number.
  KimMetric(const CollapseMesh& mesh, const UnitPositions& positions, const QemOptions& qem, const KimOptions& options);

  /// (1 + Q)(1 + I(u))(1 + C(u→v)) (eq. 17), lengths in units of `unit`.
  [[nodiscard]] double cost(std::uint32_t u, std::uint32_t v) const {
    return (1 + qem_.cost(u, v) * length4_) * (1 + static_cast<double>(importance_[u])) * (1 + color_error(u, v));
  }
  [[nodiscard]] double cost(std::uint32_t u, std::uint32_t v, std::uint32_t) const { return cost(u, v); }
  /// Takes u and its neighbours, counter-clockwise, in hand; until something changes:
  void surround(std::uint32_t u, std::span<const CollapseCandidate> neighbors);
  /// never above the cost of u → neighbours[i]: of equation 16 the neighbour gone to alone, whose other product is 0 (all terms are ≥ 0, and
  /// sums and products of such round to no less than with smaller ones);
  [[nodiscard]] double bound_of(std::size_t i) const { return bounds_[i]; }
  /// and the bits of that cost.
  [[nodiscard]] double cost_of(std::size_t i);
  /// Of the quadrics alone.
  [[nodiscard]] double squared_distance(std::uint32_t u, std::uint32_t v, double) const {
    return qem_.squared_distance(u, v, qem_.cost(u, v));
  }

  /// I(v) (eqs. 14, 15).
  [[nodiscard]] double importance(std::uint32_t v) const { return importance_[v]; }
  /// C(u→v) (eq. 16, its last factor read as ‖v1 − vi‖), over the neighbours that u has now; each product of a colour distance and a length
  /// as one
  /// square root.
  [[nodiscard]] double color_error(std::uint32_t u, std::uint32_t v) const;

  void collapse(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge);
  [[nodiscard]] std::size_t state_bytes() const {
    return qem_.state_bytes() + importance_.size() * sizeof(importance_[0]) + largest_.size() * sizeof(largest_[0]);
  }

 private:
  /// What equation 16 asks of a vertex.
  struct Point {
    double x, y, z, r, g, b;
  };
  [[nodiscard]] Point point(std::uint32_t v) const;
  static double squared_color_distance(const Point& a, const Point& b);
  static double product(const Point& a, const Point& b);
  void write_products(const Point& p, double* to) const;

  const CollapseMesh& mesh_;
  const std::vector<Vec3f>& places_;
  QemMetric qem_;
  double length_ = 1, length4_ = 1;  // a length of 1 of the unit cube, and its fourth power, in units
  std::vector<float> importance_, largest_;
  // Of the neighbours in hand, number by number: places and colours, the products with u's, terms of equation 16, bounds, and costs without C.
  std::vector<double> x_, y_, z_, r_, g_, b_, products_, terms_, bounds_, bases_;
  std::size_t count_ = 0;
};

}  // namespace etalon::simplify
