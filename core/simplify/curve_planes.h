// What every quadric metric adds up at its start: the faces around a vertex, and the planes that hold curves in place.
#pragma once

#include <cmath>

#include "core/simplify/unit_positions.h"

namespace etalon::simplify {

struct QemOptions {
  /// Weights of the planes that stand perpendicular on faces along curves, times the squared length of the edge: what keeps borders in
  /// place.
  double boundary_weight = 10, seam_weight = 1;
};

/// Calls visit(h) for every half-edge that leaves u, one a face, counter-clockwise.
template <class Visit>
void for_each_corner(const CollapseMesh& mesh, std::uint32_t u, const Visit& visit) {
  const std::uint32_t first = mesh.first_out(u);
  std::uint32_t h = first;
  do {
    visit(h);
    h = mesh.rotate(h);
  } while (h != kNone && h != first);
}

/// One face seen from its corner at a vertex: the sides that leave it, and their cross product.
struct FaceSides {
  Vec3d out, in, normal;
  double doubled_area = 0;
};

inline FaceSides face_sides(const CollapseMesh& mesh, const UnitPositions& positions, std::uint32_t h) {
  const Vec3f& at = positions.at[mesh.start(h)];
  FaceSides sides;
  sides.out = difference_of(at, positions.at[mesh.end(h)]);
  sides.in = difference_of(at, positions.at[mesh.start(CollapseMesh::previous(h))]);
  sides.normal = cross_product(sides.out, sides.in);
  sides.doubled_area = std::sqrt(dot_product(sides.normal, sides.normal));
  return sides;
}

/// Calls add(unit normal, weight) for the planes through the corner at the start of h that stand perpendicular on its face along its curve
/// edges
/// [Garland & Heckbert 1997, sec. 6]: normal e × n, weight·|e|².
template <class Add>
void for_each_curve_plane(const CollapseMesh& mesh, std::uint32_t h, const FaceSides& sides, const QemOptions& options, const Add& add) {
  const auto along = [&](std::uint32_t edge, const Vec3d& direction) {
    if (!mesh.on_curve(edge)) return;
    const Vec3d across = cross_product(direction, sides.normal);
    const double length = std::sqrt(dot_product(across, across));
    if (length == 0) return;
    const double weight = mesh.opposite(edge) == kNone ? options.boundary_weight : options.seam_weight;
    add(Vec3d{across.x / length, across.y / length, across.z / length}, weight * dot_product(direction, direction));
  };
  along(h, sides.out);
  along(CollapseMesh::previous(h), sides.in);
}

}  // namespace etalon::simplify
