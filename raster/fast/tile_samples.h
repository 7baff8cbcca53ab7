// Which triangle each texel of a tile shows, found fast: the same answer as raster/visibility.h by other means.
#pragma once

#include <cstdint>
#include <vector>

#include "core/draw/draw_list.h"
#include "raster/fast/kernels.h"
#include "raster/sample_values.h"
#include "raster/visibility.h"

namespace etalon::raster::fast {

/// Elements behind a tile's last texel that a vector may read or write back.
inline constexpr int kTileSlack = 16;
inline constexpr std::uint32_t kNoSlot = 0;

/// One tile, rows kTileSize apart; a vector may begin at any texel.
struct TileSamples {
  alignas(
      64) std::uint32_t slot[kTileSize * kTileSize + kTileSlack];  ///< place in the tile's list of triangles, from 1; kNoSlot where none
  alignas(64) float depth[kTileSize * kTileSize + kTileSlack];     ///< kept with depth: of the visible triangle; 1 where none
  alignas(64) float runner_up[kTileSize * kTileSize];              ///< kept with runner_up: next depth in depth order; +inf where none
};

/// What has to be kept beside the slots.
struct SampleNeeds {
  bool depth = false;
  bool runner_up = false;  ///< needs depth
};

[[nodiscard]] TileFrame tile_frame_of(const Frame& frame, const Tile& tile);

/// Draws the triangles `ids` (ascending) into the tile.
void find_samples(const DrawList& list, const Frame& frame, const Tile& tile, const std::uint32_t* ids, std::size_t count,
                  SampleNeeds needs, const Kernels& kernels, TileSamples& samples, EvaluationCounters& counters);

}  // namespace etalon::raster::fast
