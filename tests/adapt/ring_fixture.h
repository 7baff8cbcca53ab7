// Rings of collapses for tests.
#pragma once

#include "core/adapt/collapse_ring.h"
#include "core/adapt/edge_ring.h"
#include "core/base/rng.h"

namespace etalon::test {

/// An unfolded ring with random corners around u: in space anywhere, or (planar) in one plane where the triangles are unfolded too, but
/// other ones than in the texture.
[[nodiscard]] adapt::CollapseRing random_ring(Rng& rng, int corners, bool planar, bool on_curve);

/// Likewise for the collapse of an edge; at least 4 corners.
[[nodiscard]] adapt::EdgeRing random_edge_ring(Rng& rng, int corners, bool planar);

}  // namespace etalon::test
