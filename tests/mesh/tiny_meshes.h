// Literal meshes for tests.
#pragma once

#include <initializer_list>
#include <vector>

#include "core/mesh/mesh.h"

namespace etalon::test {

/// One wedge per vertex; uv = (x, y) of the position.
inline Mesh mesh_of(const std::vector<Vec3f>& positions, const std::vector<std::array<std::uint32_t, 3>>& faces) {
  Mesh mesh;
  mesh.positions = positions;
  mesh.has_uv = true;
  for (std::uint32_t v = 0; v < positions.size(); ++v) mesh.wedges.push_back({VertexId(v), {positions[v].x, positions[v].y}});
  for (const auto& f : faces) mesh.faces.push_back({WedgeId(f[0]), WedgeId(f[1]), WedgeId(f[2])});
  return mesh;
}

/// Gives corner k of face f its own wedge at uv.
inline void set_corner_uv(Mesh& mesh, std::uint32_t f, std::size_t k, Vec2f uv) {
  const VertexId v = mesh.wedges[mesh.faces[f][k].index].vertex;
  mesh.faces[f][k] = WedgeId(mesh.wedges.size());
  mesh.wedges.push_back({v, uv});
}

/// The unit square as two triangles, 0-1-2 and 0-2-3, counter-clockwise.
inline Mesh square() { return mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}); }

/// A closed tetrahedron, faces counter-clockwise from outside.
inline Mesh tetrahedron() { return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}); }

/// A torus of 3 × 3 squares.
inline Mesh torus() {
  std::vector<Vec3f> positions;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) positions.push_back({static_cast<float>(i), static_cast<float>(j), static_cast<float>(i * j)});
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (std::uint32_t j = 0; j < 3; ++j)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t a = 3 * j + i, b = 3 * j + (i + 1) % 3, c = 3 * ((j + 1) % 3) + (i + 1) % 3, d = 3 * ((j + 1) % 3) + i;
      faces.push_back({a, b, c});
      faces.push_back({a, c, d});
    }
  return mesh_of(positions, faces);
}

}  // namespace etalon::test
