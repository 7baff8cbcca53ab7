// Which triangle each texel of a tile shows: exact coverage, then depth as the contract stores and compares it.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/draw/draw_list.h"
#include "raster/edges.h"
#include "raster/triangle_setup.h"

namespace etalon::raster {

/// A rectangle of the frame, at most kTileSize texels a side.
struct Tile {
  int x0 = 0, y0 = 0, width = 0, height = 0;
};
inline constexpr int kTileSize = 64;

/// The outcome for one tile, texels row by row.
struct TileVisibility {
  std::vector<std::uint32_t> triangle;  ///< kNoTriangle where none
  std::vector<float> depth;             ///< of the visible triangle; 1 where none
  std::vector<float> runner_up;         ///< next depth in depth order; +inf where none. Kept only when asked for.
};

/// Window depth at a sample inside the triangle: ΣE_i·z_i / ΣE_i rounded once to float32.
[[nodiscard]] float stored_depth(const EdgeValues& e, std::int64_t area2, const ExactTriple& z);

/// Draws the triangles `ids` (ascending) into a tile.
void resolve_visibility(const DrawList& list, const Frame& frame, const Tile& tile, std::span<const std::uint32_t> ids, bool keep_runner_up,
                        TileVisibility& result);

}  // namespace etalon::raster
