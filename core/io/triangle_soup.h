// What every mesh format boils down to before it becomes a Mesh: vertices, triangles, and texture coordinates per vertex or per corner.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/mesh.h"

namespace etalon::io {

struct TriangleSoup {
  std::vector<Vec3f> positions;                     ///< #V, finite
  std::vector<Vec4f> colors;                        ///< #V or empty
  std::vector<Vec2f> vertex_uvs;                    ///< #V or empty
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< #F, indices below #V (checked by the reader, which knows the place in the file)
  std::vector<std::array<Vec2f, 3>> corner_uvs;     ///< #F or empty; at most one kind of texture coordinate is given
  std::vector<std::uint32_t> face_materials;        ///< #F or empty
};

/// The mesh: vertices in order, also those which no face uses. Coordinates of corners: one wedge for each different (vertex, uv), numbered in
/// the order of first use by the faces. Otherwise wedge i is vertex i, seen with its coordinate.
[[nodiscard]] Mesh to_mesh(TriangleSoup&& soup);

}  // namespace etalon::io
