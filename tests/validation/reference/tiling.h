// Random meshes whose triangles cover the whole frame without gap or overlap, in integers: none is turned over, neighbours share
// vertices, and the outline lies outside the frame. So each sample belongs to exactly one triangle.
#pragma once

#include <cstdint>

#include "tests/validation/reference/scene_generator.h"

namespace etalon::validation::reference {

enum class TilingKind : std::uint8_t {
  fan,          ///< around one point; many slivers meet in it
  strip,        ///< between two lines, down to slivers thinner than a sub-texel
  grid,         ///< jittered, or with vertices and edges exactly on texel centres
  subdivision,  ///< of one rectangle by random points: triangles of all sizes, some without area
};

/// A frame of size × size texels with a `triangle_id` target, no depth test, and the tiling in mixed windings.
[[nodiscard]] Scene random_tiling(std::uint64_t seed, TilingKind kind, int size);

[[nodiscard]] const char* to_string(TilingKind kind);

}  // namespace etalon::validation::reference
