// The cells of one full-edge collapse inside a chart: as ring_cells.h, for two vertices that become one.
#pragma once

#include "core/adapt/edge_ring.h"
#include "core/adapt/ring_cells.h"

namespace etalon::adapt {

/// Corners that a ring may have; more are no_place.
inline constexpr std::size_t kMostEdgeCorners = 200;

/// What the cells of a full-edge collapse were made with.
struct EdgeChoice {
  OverlayPlane plane = OverlayPlane::edge_space;  ///< not texture_after
  double place_share = 1, crossing_share = 1;
};

/// Nodes: u, v, w, the ring, the crossings. u and v go to the nearest points of the fan after, w to the nearest of the triangles before; a
/// crossing lies at the nearest points of its two edges. The edges are laid over each other in a plane of space first, where that plane shows
/// no fold: on a flat piece of surface that is the truth. Else in the texture after, with u and v as far towards their nearest points, and then
/// w and the crossings towards theirs, as kPlaceShares and kCrossingShares allow: the first that leaves all cells positive, decided exactly on
/// the float32 coordinates stored. With both at 0 the overlay is the plain one of the two triangulations, the same in both textures, and the map
/// the identity: positive by construction but for rounding. Nothing where all fails, or where the overlay is degenerate.
/// The ring must be unfolded (InputError) with a position for each of 3 to kMostEdgeCorners corners; nothing for more.
[[nodiscard]] std::optional<RingCells> make_edge_cells(const EdgeRing& ring);

/// The cells of one choice; nothing where they are not positive.
[[nodiscard]] std::optional<RingCells> edge_cells_at(const EdgeRing& ring, const EdgeChoice& choice);

}  // namespace etalon::adapt
