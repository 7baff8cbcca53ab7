// Small meshes of every kind that simplification meets.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/base/rng.h"
#include "core/mesh/weld.h"
#include "tests/mesh/tiny_meshes.h"

namespace etalon::test {

/// n × n squares over the unit square with random heights below `height`; open; uv = (x, y).
inline Mesh bumpy_grid(std::uint32_t n, float height, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Vec3f> positions;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i)
      positions.push_back(
          {static_cast<float>(i) / static_cast<float>(n), static_cast<float>(j) / static_cast<float>(n), rng.uniform(0, height)});
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
      faces.push_back({a, b, c});
      faces.push_back({a, c, d});
    }
  return mesh_of(positions, faces);
}

/// The octahedron, each face in n² parts, on a sphere of radius 1 disturbed by up to `height`; closed, without uv.
inline Mesh bumpy_sphere(std::uint32_t n, float height, std::uint64_t seed) {
  const Vec3f corners[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const std::array<std::size_t, 3> octants[8] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  Mesh mesh;
  for (const auto& octant : octants) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    std::vector<std::uint32_t> row_start;
    for (std::uint32_t j = 0; j <= n; ++j) {
      row_start.push_back(static_cast<std::uint32_t>(mesh.positions.size()) - base);
      for (std::uint32_t i = 0; i + j <= n; ++i)
        mesh.positions.push_back((corners[octant[0]] * static_cast<float>(n - i - j) + corners[octant[1]] * static_cast<float>(i) +
                                  corners[octant[2]] * static_cast<float>(j)) /
                                 static_cast<float>(n));
    }
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i + j < n; ++i) {
        const std::uint32_t a = base + row_start[j] + i, b = a + 1, c = base + row_start[j + 1] + i;
        mesh.faces.push_back({WedgeId(a), WedgeId(b), WedgeId(c)});
        if (i + j + 1 < n) mesh.faces.push_back({WedgeId(b), WedgeId(c + 1), WedgeId(c)});
      }
  }
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) mesh.wedges.push_back({VertexId(v), {0, 0}});
  mesh = welded_by_position(mesh);
  Rng rng(seed);
  for (Vec3f& p : mesh.positions) {
    const float length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
    p = p * ((1 + rng.uniform(0, height)) / length);
  }
  return mesh;
}

/// A bumpy grid whose right half is a chart of its own, mirrored: its uv is (3 − x, y). The seam runs along the middle column; its ends are on the
/// boundary, hence locked. n must be even.
inline Mesh seamed_grid(std::uint32_t n, float height, std::uint64_t seed) {
  Mesh mesh = bumpy_grid(n, height, seed);
  std::vector<std::uint32_t> right(mesh.vertex_count(), 0xFFFFFFFFu);
  for (auto& face : mesh.faces) {
    float x = 0;
    for (const WedgeId w : face) x += mesh.positions[mesh.wedges[w.index].vertex.index].x / 3;
    if (x < 0.5f) continue;
    for (WedgeId& w : face) {
      const VertexId v = mesh.wedges[w.index].vertex;
      if (right[v.index] == 0xFFFFFFFFu) {
        right[v.index] = static_cast<std::uint32_t>(mesh.wedge_count());
        mesh.wedges.push_back({v, {3 - mesh.positions[v.index].x, mesh.positions[v.index].y}});
      }
      w = WedgeId(right[v.index]);
    }
  }
  return mesh;
}

/// Both meshes in one, side by side.
inline Mesh joined(Mesh a, const Mesh& b, Vec3f offset) {
  const auto vertices = static_cast<std::uint32_t>(a.vertex_count());
  const auto wedges = static_cast<std::uint32_t>(a.wedge_count());
  for (const Vec3f& p : b.positions) a.positions.push_back(p + offset);
  for (const Wedge& w : b.wedges) a.wedges.push_back({VertexId(w.vertex.index + vertices), w.uv});
  for (const auto& f : b.faces)
    a.faces.push_back({WedgeId(f[0].index + wedges), WedgeId(f[1].index + wedges), WedgeId(f[2].index + wedges)});
  return a;
}

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

inline std::vector<NamedMesh> sample_meshes() {
  Mesh materials = bumpy_grid(8, 0.2f, 5);
  for (std::size_t f = 0; f < materials.face_count(); ++f) materials.face_materials.push_back(f < materials.face_count() / 2 ? 0 : 1);
  return {{"square", square()},
          {"tetrahedron", tetrahedron()},
          {"torus", torus()},
          {"flat grid", bumpy_grid(6, 0, 1)},
          {"bumpy grid", bumpy_grid(9, 0.3f, 2)},
          {"bumpy sphere", bumpy_sphere(6, 0.3f, 3)},
          {"seamed grid", seamed_grid(8, 0.2f, 4)},
          {"two materials", materials},
          {"two components", joined(bumpy_sphere(4, 0.2f, 6), bumpy_sphere(3, 0.1f, 7), {3, 0, 0})}};
}

}  // namespace etalon::test
