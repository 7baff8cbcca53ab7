#include "core/simplify/qem_metric.h"

#include <cmath>

namespace etalon::simplify {

namespace {

// Perpendicular on the face, along an edge that starts at the quadric's own vertex: weight·|e|² of the plane with normal e × n.
void add_curve_plane(Quadric3<double>& q, const Vec3d& edge, const Vec3d& doubled_area_normal, double weight) {
  const Vec3d across = cross_product(edge, doubled_area_normal);
  const double length = std::sqrt(dot_product(across, across));
  if (length == 0) return;
  add_plane_at_origin(q, {across.x / length, across.y / length, across.z / length}, weight * dot_product(edge, edge));
}

}  // namespace

QemMetric::QemMetric(const CollapseMesh& mesh, const UnitPositions& positions, const QemOptions& options) : places_(positions.at) {
  quadrics_.resize(mesh.vertex_capacity());
  for (std::uint32_t u = 0; u < mesh.vertex_capacity(); ++u) {
    if (!mesh.vertex_alive(u)) continue;
    Quadric3<double> q;
    const std::uint32_t first = mesh.first_out(u);
    std::uint32_t h = first;
    do {
      const std::uint32_t back = CollapseMesh::previous(h);
      const Vec3d out = difference_of(places_[u], places_[mesh.end(h)]), in = difference_of(places_[u], places_[mesh.start(back)]);
      const Vec3d normal = cross_product(out, in);
      const double doubled_area = std::sqrt(dot_product(normal, normal));
      if (doubled_area > 0)
        add_plane_at_origin(q, {normal.x / doubled_area, normal.y / doubled_area, normal.z / doubled_area}, 0.5 * doubled_area);
      const auto weight = [&](std::uint32_t at) { return mesh.opposite(at) == kNone ? options.boundary_weight : options.seam_weight; };
      if (mesh.on_curve(h)) add_curve_plane(q, out, normal, weight(h));
      if (mesh.on_curve(back)) add_curve_plane(q, in, normal, weight(back));
      h = mesh.rotate(h);
    } while (h != kNone && h != first);
    quadrics_[u] = rounded(q);
  }
}

}  // namespace etalon::simplify
