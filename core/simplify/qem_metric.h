// The metric `qem`: area-weighted squared distances to the planes of all faces that a vertex has stood for.
// [Garland & Heckbert 1997]; [Kim, Choi & Lee 2008, eqs. 1-9].
#pragma once

#include "core/simplify/quadric.h"
#include "core/simplify/unit_positions.h"

namespace etalon::simplify {

struct QemOptions {
  /// Weights of the planes that stand perpendicular on faces along curves, times the squared length of the edge: what keeps borders in place.
  double boundary_weight = 10, seam_weight = 1;
};

/// State: 10 float32 a vertex, measured from the vertex itself in the unit cube and rounded once a collapse; all arithmetic in double.
/// Measured so, a vertex's own planes all pass through d = 0: b and c start as exact zeros, and nothing cancels.
class QemMetric {
 public:
  static constexpr std::size_t kStateBytes = sizeof(Quadric3<float>);
  /// The cost of u→v is of the states of u and v alone (collapse_loop.h).
  static constexpr bool kCostsAreLocal = true;

  QemMetric(const CollapseMesh& mesh, const UnitPositions& positions, const QemOptions& options);

  /// (Q_u + Q_v)(v) (eq. 9 at the place a half-edge collapse leaves), never below 0; unit: squared length × area in the unit cube.
  [[nodiscard]] double cost(std::uint32_t u, std::uint32_t v) const {
    const double q = evaluate(quadrics_[u], difference(u, v)) + quadrics_[v].c;
    return q > 0 ? q : 0;
  }

  /// cost() as a squared length of the unit cube: the weighted mean squared distance of v to the planes of both.
  [[nodiscard]] double squared_distance(std::uint32_t u, std::uint32_t v) const {
    const double weight = total_weight(quadrics_[u]) + total_weight(quadrics_[v]);
    return weight > 0 ? cost(u, v) / weight : 0;
  }

  /// v takes over the planes of u.
  void collapse(std::uint32_t u, std::uint32_t v) { quadrics_[v] = rounded(sum(quadrics_[v], moved(quadrics_[u], difference(u, v)))); }

 private:
  [[nodiscard]] Vec3d difference(std::uint32_t u, std::uint32_t v) const { return difference_of(places_[u], places_[v]); }

  const std::vector<Vec3f>& places_;
  std::vector<Quadric3<float>> quadrics_;
};

}  // namespace etalon::simplify
