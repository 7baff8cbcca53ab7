#include "core/procedural/colored_mesh.h"

#include <cmath>

#include "core/base/parallel.h"
#include "core/procedural/smooth_math.h"

namespace etalon::procedural {

Mesh colored_mesh(const std::vector<Vec3d>& positions, const std::vector<std::array<std::uint32_t, 3>>& faces,
                  const std::function<Vec3d(const Vec3d& p)>& paint) {
  Mesh mesh;
  mesh.positions.resize(positions.size());
  mesh.colors.resize(positions.size());
  mesh.wedges.resize(positions.size());
  mesh.faces.resize(faces.size());
  parallel_for_blocks(positions.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      mesh.positions[v] = Vec3f(positions[v]);
      mesh.wedges[v] = {VertexId(v), {0, 0}};
      const Vec3d color = paint(positions[v]);
      for (int k = 0; k < 3; ++k) mesh.colors[v][k] = static_cast<float>(std::floor(clamp01(color[k]) * 255 + 0.5) / 255);
      mesh.colors[v][3] = 1;
    }
  });
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) mesh.faces[f][k] = WedgeId(faces[f][k]);
  return mesh;
}

}  // namespace etalon::procedural
