#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include "tests/bench/simplify_way.h"

namespace etalon::bench {

SimplifyOutcome simplify_with_openmesh(Mesh mesh, std::size_t target_faces) {
  using Surface = OpenMesh::TriMesh_ArrayKernelT<>;
  Surface surface;
  std::vector<Surface::VertexHandle> vertices;
  vertices.reserve(mesh.vertex_count());
  for (const Vec3f& p : mesh.positions) vertices.push_back(surface.add_vertex({p.x, p.y, p.z}));
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    surface.add_face(vertices[mesh.vertex(FaceId(f), 0).index], vertices[mesh.vertex(FaceId(f), 1).index],
                     vertices[mesh.vertex(FaceId(f), 2).index]);

  mesh = {};

  const double start = process_cpu_seconds();
  OpenMesh::Decimater::DecimaterT<Surface> decimater(surface);
  OpenMesh::Decimater::ModQuadricT<Surface>::Handle quadric;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();
  decimater.initialize();
  decimater.decimate_to_faces(0, target_faces);
  SimplifyOutcome outcome{.seconds = process_cpu_seconds() - start};

  surface.garbage_collection();
  for (const Surface::VertexHandle v : surface.vertices()) {
    const auto& p = surface.point(v);
    outcome.mesh.positions.emplace_back(p[0], p[1], p[2]);
    outcome.mesh.wedges.push_back({VertexId(static_cast<std::uint32_t>(v.idx())), {0, 0}});
  }
  for (const Surface::FaceHandle f : surface.faces()) {
    std::array<WedgeId, 3> corners;
    std::size_t k = 0;
    for (auto v = surface.cfv_iter(f); v.is_valid(); ++v) corners[k++] = WedgeId(static_cast<std::uint32_t>(v->idx()));
    outcome.mesh.faces.push_back(corners);
  }
  return outcome;
}

}  // namespace etalon::bench
