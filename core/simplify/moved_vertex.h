// What a full-edge collapse u-v leaves at v: a place, a colour, texture coordinates on both sides.
#pragma once

#include "core/simplify/unit_positions.h"

namespace etalon::simplify {

struct MovedVertex {
  Vec3f at{0, 0, 0};          ///< in the unit cube
  Vec4f color{0, 0, 0, 1};    ///< where the mesh has colours
  std::array<Vec2f, 2> uv{};  ///< left and right of u→v, where it has texture coordinates; equal where no curve parts the sides
};

/// The vertex at `at` with the attributes that the surface has near it: at the nearest point of the faces of u and v, the lowest face among
/// equally
/// near ones; on a curve, at the nearest point of the edge, so that both sides stay together. Weighted in double, rounded once.
[[nodiscard]] MovedVertex carried(const CollapseMesh& mesh, const UnitPositions& positions, std::uint32_t u, std::uint32_t v,
                                  const CollapseMesh::Edge& edge, const Vec3f& at);

/// Puts it into the mesh and the unit positions; before the collapse.
void move_vertex(CollapseMesh& mesh, UnitPositions& positions, std::uint32_t v, const CollapseMesh::Edge& edge, const MovedVertex& moved);

}  // namespace etalon::simplify
