#include "core/simplify/qem_metric.h"

namespace etalon::simplify {

QemMetric::QemMetric(const CollapseMesh& mesh, const UnitPositions& positions, const QemOptions& options) : places_(positions.at) {
  shapes_.resize(mesh.vertex_capacity());
  constants_.resize(mesh.vertex_capacity());
  for (std::uint32_t u = 0; u < mesh.vertex_capacity(); ++u) {
    if (!mesh.vertex_alive(u)) continue;
    Quadric3<double> q;
    const auto add = [&](const Vec3d& normal, double weight) { add_plane_at_origin(q, normal, weight); };
    for_each_corner(mesh, u, [&](std::uint32_t h) {
      const FaceSides sides = face_sides(mesh, positions, h);
      const auto& [n, doubled_area] = std::pair(sides.normal, sides.doubled_area);
      if (doubled_area > 0) add({n.x / doubled_area, n.y / doubled_area, n.z / doubled_area}, 0.5 * doubled_area);
      for_each_curve_plane(mesh, h, sides, options, add);
    });
    store(u, q);
  }
}

}  // namespace etalon::simplify
