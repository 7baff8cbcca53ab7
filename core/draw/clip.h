// Clipping of one triangle in clip space: near, far and the guard rectangle, so that every vertex the rasterizers see is in range.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/math/vec.h"

namespace etalon {

/// A vertex in clip space, all float32: what is snapped is exactly what both renderers take.
struct ClipVertex {
  float x = 0, y = 0, z = 0, w = 1;
  Vec2f uv{0, 0};
  Vec4f color{0, 0, 0, 1};
  std::uint64_t order = 0;  ///< mesh vertex index; decides from which end an edge is cut, so neighbours cut alike
};

/// A half space: inside where x·v.x + y·v.y + z·v.z + w·v.w + constant >= 0.
struct ClipPlane {
  double x, y, z, w, constant;
};

/// near, far, left, right, bottom, top of the frame extended by `guard` texels, then w >= 2^-20 and w <= 2^20 (a far plane more than 2^23
/// times the near one no longer bounds w in float32), in this order.
[[nodiscard]] std::array<ClipPlane, 8> clip_planes(int width, int height, int guard);

/// The triangle inside all planes: a convex polygon of 0 or 3..11 vertices in the input's orientation. An intersection is computed in double
/// from the end of lower order towards the other, then rounded to float32; it takes the order of a hash of both, equal for both neighbours.
[[nodiscard]] std::vector<ClipVertex> clip_triangle(const std::array<ClipVertex, 3>& triangle, const std::array<ClipPlane, 8>& planes);

}  // namespace etalon
