// The mesh: vertices (positions), wedges (a vertex seen by the faces of one chart: its texture coordinate) and triangular faces.
// A seam vertex has several wedges [Hoppe 1996, sec. 2]. Faces name wedges; a wedge names its vertex.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/strong_id.h"
#include "core/math/vec.h"

namespace etalon {

using VertexId = StrongId<struct VertexTag>;
using WedgeId = StrongId<struct WedgeTag>;
using FaceId = StrongId<struct FaceTag>;

struct Wedge {
  VertexId vertex;
  Vec2f uv{0, 0};  ///< texture coordinate, v up: v = 0 is image row 0; meaningless where !Mesh::has_uv
  friend bool operator==(const Wedge&, const Wedge&) = default;
};

struct Mesh {
  std::vector<Vec3f> positions;               ///< #V, model units
  std::vector<Vec4f> colors;                  ///< #V or empty: RGBA in [0, 1], as stored in the file (no colour conversion)
  std::vector<Wedge> wedges;                  ///< #W
  std::vector<std::array<WedgeId, 3>> faces;  ///< #F, counter-clockwise seen from outside
  std::vector<std::uint32_t> face_materials;  ///< #F or empty (all faces of material 0): index into the model's materials
  bool has_uv = false;

  [[nodiscard]] std::size_t vertex_count() const { return positions.size(); }
  [[nodiscard]] std::size_t wedge_count() const { return wedges.size(); }
  [[nodiscard]] std::size_t face_count() const { return faces.size(); }

  [[nodiscard]] const Wedge& wedge(FaceId f, int corner) const { return wedges[faces[f.index][corner].index]; }
  [[nodiscard]] VertexId vertex(FaceId f, int corner) const { return wedge(f, corner).vertex; }
  [[nodiscard]] const Vec3f& position(FaceId f, int corner) const { return positions[vertex(f, corner).index]; }

  friend bool operator==(const Mesh&, const Mesh&) = default;
};

/// Axis-aligned box of all positions; lo > hi for a mesh without vertices.
struct BoundingBox {
  Vec3f lo{1, 1, 1};
  Vec3f hi{-1, -1, -1};
  /// Length of the diagonal in double (0 when empty).
  [[nodiscard]] double diagonal() const;
};
[[nodiscard]] BoundingBox bounding_box(const Mesh& mesh);

}  // namespace etalon
