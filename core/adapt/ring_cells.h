// The cells of one collapse: the overlay of the triangles before and after, with the place of every corner in both textures
// [Chen & Chuang 2006, sec. 3.2, Figures 5 and 6].
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/adapt/collapse_ring.h"

namespace etalon::adapt {

/// How much of the paper's places is tried, in this order: of u's way to its nearest point, and of the crossings' way to theirs.
inline constexpr std::array kPlaceShares{1.0, 0.75, 0.5, 0.25, 0.125, 0.0};
inline constexpr std::array kCrossingShares{1.0, 0.75, 0.5, 0.25, 0.125, 0.0625, 0.0};

/// A corner of cells: its texture coordinate before the collapse (in T^i) and after it (in T^(i−1)).
struct CellNode {
  Vec2f before{0, 0}, after{0, 0};
  friend bool operator==(const CellNode&, const CellNode&) = default;
};

/// In which plane the edges before and after were laid over each other.
enum class OverlayPlane : std::uint8_t {
  texture_after,       ///< of a half-edge collapse: u at its new place
  edge_texture_after,  ///< of a full-edge collapse (edge_cells.h), likewise
  edge_space,          ///< of a full-edge collapse: a plane in space
};
inline constexpr std::size_t kOverlayPlaneCount = 3;

/// The cells cover the triangles before the collapse by their `before` corners and the triangles after it by their `after` corners; in each
/// the map between both is affine, and together they are continuous.
struct RingCells {
  std::vector<CellNode> nodes;                      ///< u, the ring, then where a spoke of u crosses a diagonal from v
  std::vector<std::array<std::uint16_t, 3>> cells;  ///< #C by 3, into nodes; counter-clockwise before and after
  /// How much of the paper's places is kept: of u's way to its nearest point, and of the crossings' way from the overlay's own places to
  /// those of the nearest points in space. 1: all.
  double u_kept = 1, crossings_kept = 1;
  OverlayPlane plane = OverlayPlane::texture_after;
  friend bool operator==(const RingCells&, const RingCells&) = default;
};

/// The cells of an unfolded ring (is_unfolded; InputError otherwise; at most 16,000 corners). Every cell has positive area in both textures,
/// decided exactly on the float32 coordinates stored: u goes as far towards new_place_of_u() as kPlaceShares has it, to the first
/// place that sees the whole ring; then the crossings take as much of their nearest points (the paper's 2 × 2 system) as the first of
/// kCrossingShares that leaves all positive. With 0 both partitions are positive by construction but for rounding: the one before is the image of the overlay,
/// spoke by spoke affine. On a curve u's place is new_place_of_u() and nothing else. Nothing where even that fails, where a curve leaves no
/// triangle after the collapse (a ring of two corners), or where there would be more than 65,535 nodes.
[[nodiscard]] std::optional<RingCells> make_ring_cells(const CollapseRing& ring);

/// What make_ring_cells() gives where it chose this place of u and these shares, bit for bit: for cells that were stored. Nothing where they
/// are not positive, or the place does not see the ring. InputError as there.
[[nodiscard]] std::optional<RingCells> ring_cells_at(const CollapseRing& ring, const Vec2f& place, double u_share, double crossing_share);

}  // namespace etalon::adapt
