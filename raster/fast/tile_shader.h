// The fast path of one tile: samples, planes of what is visible, then the targets run by run. What the kernels leave undecided goes to
// store_target() of raster/sample_values.h, texel by texel.
#pragma once

#include <span>
#include <vector>

#include "core/draw/draw_list.h"
#include "raster/fast/run_values.h"
#include "raster/fast/tile_samples.h"

namespace etalon::raster::fast {

/// Texels of one row that some triangle covered.
struct CoveredRun {
  int x, y, texels;
};

/// Draws the triangles `ids` (ascending) into the tile of all images, which are the frame's targets in order. With
/// `covered` the covered runs are appended to it and all other texels keep their bytes.
EvaluationCounters draw_tile(const RunContext& context, const Tile& tile, std::span<const std::uint32_t> ids, std::vector<Image>& images,
                             std::vector<CoveredRun>* covered = nullptr);

}  // namespace etalon::raster::fast
