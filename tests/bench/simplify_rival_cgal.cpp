#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "tests/bench/simplify_way.h"

namespace etalon::bench {

SimplifyOutcome simplify_with_cgal(Mesh mesh, std::size_t target_faces) {
  namespace SMS = CGAL::Surface_mesh_simplification;
  using Kernel = CGAL::Simple_cartesian<double>;
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  using Policies = SMS::GarlandHeckbert_plane_policies<Surface, Kernel>;

  Surface surface;
  std::vector<Surface::Vertex_index> vertices;
  vertices.reserve(mesh.vertex_count());
  for (const Vec3f& p : mesh.positions) vertices.push_back(surface.add_vertex({p.x, p.y, p.z}));
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    surface.add_face(vertices[mesh.vertex(FaceId(f), 0).index], vertices[mesh.vertex(FaceId(f), 1).index],
                     vertices[mesh.vertex(FaceId(f), 2).index]);

  mesh = {};

  // Edges are what this version counts: three to two faces, and half an edge for each on a border.
  const std::size_t faces = surface.number_of_faces();
  const double edges_a_face = static_cast<double>(surface.number_of_edges()) / static_cast<double>(faces);
  const auto target_edges = static_cast<std::size_t>(edges_a_face * static_cast<double>(target_faces));
  const double start = process_cpu_seconds();
  const Policies policies(surface);
  SMS::edge_collapse(surface, SMS::Count_stop_predicate<Surface>(target_edges),
                     CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  SimplifyOutcome outcome{.seconds = process_cpu_seconds() - start};

  std::vector<std::uint32_t> id(surface.number_of_vertices() + surface.number_of_removed_vertices());
  for (const Surface::Vertex_index v : surface.vertices()) {
    id[v] = static_cast<std::uint32_t>(outcome.mesh.positions.size());
    const auto& p = surface.point(v);
    outcome.mesh.positions.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
    outcome.mesh.wedges.push_back({VertexId(id[v]), {0, 0}});
  }
  for (const Surface::Face_index f : surface.faces()) {
    std::array<WedgeId, 3> corners;
    std::size_t k = 0;
    for (const Surface::Vertex_index v : surface.vertices_around_face(surface.halfedge(f))) corners[k++] = WedgeId(id[v]);
    outcome.mesh.faces.push_back(corners);
  }
  return outcome;
}

}  // namespace etalon::bench
