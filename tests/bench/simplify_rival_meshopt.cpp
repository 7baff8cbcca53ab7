#include <limits>

#include <meshoptimizer.h>

#include "tests/bench/simplify_way.h"

namespace etalon::bench {

SimplifyOutcome simplify_with_meshopt(Mesh mesh, std::size_t target_faces) {
  std::vector<unsigned> indices;
  indices.reserve(3 * mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) indices.push_back(mesh.vertex(FaceId(f), k).index);
  std::vector<unsigned> kept(indices.size());

  const double start = process_cpu_seconds();
  const std::size_t count = meshopt_simplify(kept.data(), indices.data(), indices.size(), &mesh.positions[0].x, mesh.vertex_count(),
                                             sizeof(Vec3f), 3 * target_faces, std::numeric_limits<float>::max(), 0, nullptr);
  SimplifyOutcome outcome{.seconds = process_cpu_seconds() - start};

  // Vertices stay where they are and keep their colours.
  constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  std::vector<std::uint32_t> id(mesh.vertex_count(), kNone);
  for (std::size_t i = 0; i < count; i += 3) {
    std::array<WedgeId, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const unsigned v = kept[i + k];
      if (id[v] == kNone) {
        id[v] = static_cast<std::uint32_t>(outcome.mesh.positions.size());
        outcome.mesh.positions.push_back(mesh.positions[v]);
        if (!mesh.colors.empty()) outcome.mesh.colors.push_back(mesh.colors[v]);
        outcome.mesh.wedges.push_back({VertexId(id[v]), {0, 0}});
      }
      corners[k] = WedgeId(id[v]);
    }
    outcome.mesh.faces.push_back(corners);
  }
  return outcome;
}

}  // namespace etalon::bench
