// The metric `qem`: area-weighted squared distances to the planes of all faces that a vertex has stood for.
// [Garland & Heckbert 1997]; [Kim, Choi & Lee 2008, eqs. 1-9].
#pragma once

#include <span>

#include "core/simplify/curve_planes.h"
#include "core/simplify/moved_vertex.h"
#include "core/simplify/placement.h"
#include "core/simplify/quadric.h"

namespace etalon::simplify {

/// State: 10 float32 a vertex, measured from the vertex itself in the unit cube and rounded once a collapse; all arithmetic in double.
/// Measured so, a vertex's own planes all pass through d = 0: b and c start as exact zeros, and nothing cancels.
class QemMetric {
 public:
  /// The cost of u→v is of the states of u and v alone (collapse_loop.h).
  static constexpr bool kCostsAreLocal = true;

  QemMetric(const CollapseMesh& mesh, const UnitPositions& positions, const QemOptions& options);

  /// (Q_u + Q_v)(v) (eq. 9 at the place a half-edge collapse leaves), never below 0; unit: squared length × area in the unit cube.
  [[nodiscard]] double cost(std::uint32_t u, std::uint32_t v) const {
    const double q = evaluate(quadrics_[u], difference(u, v)) + quadrics_[v].c;
    return q > 0 ? q : 0;
  }
  [[nodiscard]] double cost(std::uint32_t u, std::uint32_t v, std::uint32_t) const { return cost(u, v); }

  /// A cost as a squared length of the unit cube: the weighted mean squared distance of v to the planes of both.
  [[nodiscard]] double squared_distance(std::uint32_t u, std::uint32_t v, double cost) const {
    const double weight = total_weight(quadrics_[u]) + total_weight(quadrics_[v]);
    return weight > 0 ? cost / weight : 0;
  }

  /// v takes over the planes of u.
  void collapse(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge&) {
    quadrics_[v] = rounded(sum(quadrics_[v], moved(quadrics_[u], difference(u, v))));
  }

  /// Where Q_u + Q_v is least (eq. 9's minimum, −A⁻¹b), the metric's own part of a full-edge collapse.
  [[nodiscard]] Placement place(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge&) const {
    const Quadric3<double> merged = sum(quadrics_[v], moved(quadrics_[u], difference(u, v)));
    return place_vertex(places_[v], places_[u], std::span<const Quadric3<double>>(&merged, 1), {}, NoAttributes{});
  }
  void merge(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge&, const Placement& placement) {
    const Quadric3<double> merged = sum(quadrics_[v], moved(quadrics_[u], difference(u, v)));
    quadrics_[v] = rounded(moved(merged, difference_of(places_[v], placement.at)));
  }

  void adopt(const Placement&, std::uint32_t, std::uint32_t, const CollapseMesh::Edge&, MovedVertex&) const {}

  [[nodiscard]] std::size_t state_bytes() const { return quadrics_.size() * sizeof(quadrics_[0]); }

 private:
  [[nodiscard]] Vec3d difference(std::uint32_t u, std::uint32_t v) const { return difference_of(places_[u], places_[v]); }

  const std::vector<Vec3f>& places_;
  std::vector<Quadric3<float>> quadrics_;
};

}  // namespace etalon::simplify
