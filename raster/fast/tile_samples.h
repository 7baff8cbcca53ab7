// Which triangle each texel of a tile shows, found fast: the same answer as raster/visibility.h by other means.
#pragma once

#include <cstdint>
#include <vector>

#include "core/draw/draw_list.h"
#include "raster/fast/kernels.h"
#include "raster/sample_values.h"
#include "raster/visibility.h"

namespace etalon::raster::fast {

inline constexpr std::uint32_t kNoSlot = 0xFFFFFFFFu;

/// One tile, rows kTileSize apart.
struct TileSamples {
  alignas(64) std::uint32_t slot[kTileSize * kTileSize];  ///< index into the tile's list of triangles; kNoSlot where none
  alignas(64) float depth[kTileSize * kTileSize];         ///< kept with depth: of the visible triangle; 1 where none
  alignas(64) float runner_up[kTileSize * kTileSize];     ///< kept with runner_up: next depth in depth order; +inf where none
};

/// What has to be kept beside the slots.
struct SampleNeeds {
  bool depth = false;
  bool runner_up = false;  ///< needs depth
};

/// Draws the triangles `ids` (ascending) into the tile.
void find_samples(const DrawList& list, const Frame& frame, const Tile& tile, const std::uint32_t* ids, std::size_t count,
                  SampleNeeds needs, const Kernels& kernels, TileSamples& samples, EvaluationCounters& counters);

}  // namespace etalon::raster::fast
