// The metric `qem`: area-weighted squared distances to the planes of all faces that a vertex has stood for.
// [Garland & Heckbert 1997]; [Kim, Choi & Lee 2008, eqs. 1-9].
#pragma once

#include <algorithm>
#include <span>

#include "core/simplify/collapse_candidate.h"
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
    const double q = evaluate(state(u), difference(u, v)) + constants_[v];
    return q > 0 ? q : 0;
  }
  [[nodiscard]] double cost(std::uint32_t u, std::uint32_t v, std::uint32_t) const { return cost(u, v); }
  void costs(std::uint32_t u, std::span<CollapseCandidate> candidates) const {
    const Quadric3<double> own = state(u);
    const Vec3f at = places_[u];
    for (CollapseCandidate& candidate : candidates) {
      const double q = evaluate(own, difference_of(at, places_[candidate.target])) + constants_[candidate.target];
      candidate.cost = q > 0 ? q : 0;
    }
  }

  /// A cost as a squared length of the unit cube: the weighted mean squared distance of v to the planes of both.
  [[nodiscard]] double squared_distance(std::uint32_t u, std::uint32_t v, double cost) const {
    const double weight = total_weight(state(u)) + total_weight(state(v));
    return weight > 0 ? cost / weight : 0;
  }

  /// v takes over the planes of u; its own error does not fall, whatever the rounding of a sum that is about 0.
  void collapse(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge&) {
    const float own = constants_[v];
    store(v, merged(u, v));
    constants_[v] = std::max(constants_[v], own);
  }

  /// Where Q_u + Q_v is least (eq. 9's minimum, −A⁻¹b), the metric's own part of a full-edge collapse.
  [[nodiscard]] Placement place(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge&) const {
    const Quadric3<double> both = merged(u, v);
    return place_vertex(places_[v], places_[u], std::span<const Quadric3<double>>(&both, 1), {}, NoAttributes{});
  }
  void merge(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge&, const Placement& placement) {
    store(v, moved(merged(u, v), difference_of(places_[v], placement.at)));
  }
  void adopt(const Placement&, std::uint32_t, std::uint32_t, const CollapseMesh::Edge&, MovedVertex&) const {}

  /// Measured from v.
  [[nodiscard]] Quadric3<double> state(std::uint32_t v) const {
    const std::array<float, 9>& s = shapes_[v];
    return {s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], s[8], constants_[v]};
  }
  /// What v costs where it is.
  [[nodiscard]] float constant(std::uint32_t v) const { return constants_[v]; }
  [[nodiscard]] std::size_t state_bytes() const { return shapes_.size() * sizeof(shapes_[0]) + constants_.size() * sizeof(constants_[0]); }

 private:
  [[nodiscard]] Vec3d difference(std::uint32_t u, std::uint32_t v) const { return difference_of(places_[u], places_[v]); }
  // Each coefficient rounded once.
  void store(std::uint32_t v, const Quadric3<double>& quadric) {
    const Quadric3<float> q = rounded(quadric);
    shapes_[v] = {q.xx, q.xy, q.xz, q.yy, q.yz, q.zz, q.x, q.y, q.z};
    constants_[v] = q.c;
  }
  // Measured from v.
  [[nodiscard]] Quadric3<double> merged(std::uint32_t u, std::uint32_t v) const { return sum(state(v), moved(state(u), difference(u, v))); }

  const std::vector<Vec3f>& places_;
  std::vector<std::array<float, 9>> shapes_;  // A and b
  std::vector<float> constants_;              // c: apart, since the cost of u→v asks nothing else of v
};

}  // namespace etalon::simplify
