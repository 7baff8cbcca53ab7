#include "core/simplify/extract.h"

namespace etalon::simplify {

void extract(const CollapseMesh& triangles, SimplifyResult& result) {
  const Mesh& source = triangles.source();
  Mesh& mesh = result.mesh;
  mesh.has_uv = source.has_uv;
  std::vector<bool> vertex_used(source.vertex_count(), false), wedge_used(source.wedge_count(), false);
  // Without texture coordinates a vertex needs one wedge: the first one that names it.
  std::vector<std::uint32_t> only_wedge;
  if (!source.has_uv) {
    only_wedge.assign(source.vertex_count(), kNone);
    for (std::uint32_t w = static_cast<std::uint32_t>(source.wedge_count()); w-- > 0;) only_wedge[source.wedges[w].vertex.index] = w;
  }
  const auto wedge_at = [&](std::uint32_t h) {
    return source.has_uv ? triangles.wedge(h) : only_wedge[triangles.origin(triangles.start(h))];
  };
  for (std::uint32_t f = 0; f < triangles.face_capacity(); ++f) {
    if (!triangles.face_alive(f)) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      vertex_used[triangles.origin(triangles.start(4 * f + k))] = true;
      wedge_used[wedge_at(4 * f + k)] = true;
    }
  }

  std::vector<std::uint32_t> new_vertex(source.vertex_count(), kNone), new_wedge(source.wedge_count(), kNone);
  for (std::uint32_t v = 0; v < source.vertex_count(); ++v) {
    if (!vertex_used[v]) continue;
    new_vertex[v] = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(triangles.position(v));
    if (!source.colors.empty()) mesh.colors.push_back(triangles.color(v));
    result.source_vertex.push_back(VertexId(v));
  }
  for (std::uint32_t w = 0; w < source.wedge_count(); ++w) {
    if (!wedge_used[w]) continue;
    new_wedge[w] = static_cast<std::uint32_t>(mesh.wedges.size());
    mesh.wedges.push_back(
        {VertexId(new_vertex[source.wedges[w].vertex.index]), source.has_uv ? triangles.uv_of_wedge(w) : source.wedges[w].uv});
    result.source_wedge.push_back(WedgeId(w));
  }
  mesh.faces.reserve(triangles.face_count());
  result.source_face.reserve(triangles.face_count());
  for (std::uint32_t f = 0; f < triangles.face_capacity(); ++f) {
    if (!triangles.face_alive(f)) continue;
    mesh.faces.push_back(
        {WedgeId(new_wedge[wedge_at(4 * f)]), WedgeId(new_wedge[wedge_at(4 * f + 1)]), WedgeId(new_wedge[wedge_at(4 * f + 2)])});
    if (!source.face_materials.empty()) mesh.face_materials.push_back(source.face_materials[f]);
    result.source_face.push_back(FaceId(f));
  }
}

}  // namespace etalon::simplify
