// The texture coordinates of the procedural head.
#pragma once

#include "core/mesh/mesh.h"
#include "core/procedural/tube_mesh.h"

namespace etalon::procedural {

/// Unwraps the head: the skin as a rectangle cut along the ventral midline, a row per ring; the tip of the bill and the base of the neck
/// as discs; each eye as seen from behind its ball, as far as nothing there covers another part. Vertices and faces keep their order.
[[nodiscard]] Mesh unwrapped_head(const TubeMesh& tube);

}  // namespace etalon::procedural
