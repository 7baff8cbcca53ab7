// Where a full-edge collapse puts the vertex that stays: where the merged quadrics are least.
// [Garland & Heckbert 1997, sec. 4.1]; [Garland & Heckbert 1998, sec. 3.1].
#pragma once

#include <limits>
#include <span>

#include "core/simplify/quadric.h"

namespace etalon::simplify {

/// At most the two sides of a curve.
inline constexpr std::size_t kMaxSides = 2;

struct Placement {
  double cost = std::numeric_limits<double>::infinity();
  Vec3f at{0, 0, 0};  ///< in the unit cube, rounded: the cost is that of this place
  /// What a metric with attributes chose for each side (side 0 first that exists, as the metric numbers them), rounded and in range
  /// likewise.
  std::array<std::array<float, 3>, kMaxSides> attributes{};
};

/// Rounds the attributes of one side to what is stored: how far they are then from those of v, in the quadric's scale.
struct NoAttributes {
  std::array<double, 0> operator()(std::size_t, const std::array<double, 0>&, std::array<float, 3>&) const { return {}; }
};

/// The position and the attributes of each side that make the sum of the merged quadrics least, rounded. Where the sum leaves them open (a
/// flat
/// or straight neighbourhood, pivots below kLeastPivot): the best of v, u and the middle between them, in this order.
/// merged: measured from v, one a side; to_u: the step from v to u of each side, or empty without attributes.
template <class Quadric, class Round>
Placement place_vertex(const Vec3f& at_v, const Vec3f& at_u, std::span<const Quadric> merged,
                       std::span<const AttributeStep<Quadric::kAttributes>> to_u, const Round& round) {
  constexpr std::size_t m = Quadric::kAttributes;
  using Attributes = std::array<double, m>;
  const auto placed = [&](const Vec3d& wanted, const auto& attributes_of) {
    Placement placement;
    placement.at = {static_cast<float>(at_v.x + wanted.x), static_cast<float>(at_v.y + wanted.y), static_cast<float>(at_v.z + wanted.z)};
    const Vec3d d = difference_of(at_v, placement.at);
    double cost = 0;
    for (std::size_t side = 0; side < merged.size(); ++side) {
      const Attributes attributes = round(side, attributes_of(side, d), placement.attributes[side]);
      cost += evaluate(merged[side], step_of<m>(d, attributes));
    }
    placement.cost = cost > 0 ? cost : 0;
    return placement;
  };

  double weight = 0;
  for (const Quadric& q : merged) weight += total_weight(q);
  std::array<Quadric, kMaxSides> reduced{};
  Quadric3<double> space;
  bool solvable = true;
  for (std::size_t side = 0; side < merged.size() && solvable; ++side) {
    reduced[side] = merged[side];
    solvable = eliminate_attributes(reduced[side], kLeastPivot * weight);
    if (solvable) space = sum(space, position_part(reduced[side]));
  }
  if (solvable)
    if (const std::optional<Vec3d> best = minimum(space, kLeastPivot * weight))
      return placed(*best, [&](std::size_t side, const Vec3d& d) { return best_attributes(reduced[side], d); });

  const Vec3d whole = difference_of(at_v, at_u);
  Placement best;
  for (const double t : {0.0, 1.0, 0.5}) {
    const Placement at_t = placed({t * whole.x, t * whole.y, t * whole.z}, [&](std::size_t side, const Vec3d&) {
      Attributes attributes{};
      for (std::size_t j = 0; j < m; ++j) attributes[j] = t * to_u[side].x[3 + j];
      return attributes;
    });
    if (at_t.cost < best.cost) best = at_t;
  }
  return best;
}

}  // namespace etalon::simplify
