// Two triangulations of one polygon laid over each other in a plane: that of an edge before its collapse, and the fan after it. Exact.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/adapt/crossing_parameters.h"
#include "core/adapt/edge_ring.h"

namespace etalon::adapt {

/// Which edges cross, and the convex pieces between all edges.
struct EdgeOverlay {
  struct Crossing {
    std::array<std::uint16_t, 2> edge;  ///< before the collapse, by nodes
    std::uint16_t corner = 0;           ///< node of the ring: the edge w–corner after it
    CrossingParameters at;              ///< in this plane: along `edge`, and from w
  };
  std::vector<Crossing> crossings;                 ///< node #R + 3 + i each
  std::vector<std::vector<std::uint16_t>> pieces;  ///< convex, counter-clockwise, by nodes
  std::array<std::uint16_t, 3> holder{};           ///< the triangle before that w is in, and its weights
  Vec3d weights{1, 0, 0};
};

/// `places`: of u, v, w and the ring. Nothing where a triangle of either side is not counter-clockwise there, or where three edges meet in a
/// point (w on an edge before, an edge after through u or v): such places are refused, not resolved. O(#R²); decisions by orientation() alone.
[[nodiscard]] std::optional<EdgeOverlay> overlay_edge_ring(const EdgeRing& ring, std::span<const Vec2f> places);

}  // namespace etalon::adapt
