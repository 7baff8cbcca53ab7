#include "core/adapt/vertex_faces.h"

#include <algorithm>

namespace etalon::adapt {

using progressive::ProgressiveMesh;

VertexFaces::VertexFaces(const ProgressiveMesh& mesh) {
  if (mesh.data().moves.empty()) return;
  faces_.resize(mesh.data().positions.size());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    for (const std::uint32_t w : mesh.face_wedges(f)) faces_[mesh.data().wedges[w].vertex.index].push_back(f);
}

void VertexFaces::coarsen(const ProgressiveMesh& mesh, std::size_t split) {
  if (faces_.empty()) return;
  const progressive::ProgressiveData& data = mesh.data();
  const progressive::VertexSplit& s = data.splits[split];
  for (std::uint32_t f = s.first_face; f < mesh.face_count_at(split + 1); ++f)
    for (const std::uint32_t w : data.faces[f]) {
      std::vector<std::uint32_t>& around = faces_[data.wedges[w].vertex.index];
      around.erase(std::remove(around.begin(), around.end(), f), around.end());
    }
  for (std::uint32_t c = s.first_corner; c < s.end_corner; ++c) faces_[s.parent].push_back(data.corners[c] >> 2);
  faces_[data.base_vertices + split].clear();
}

}  // namespace etalon::adapt
