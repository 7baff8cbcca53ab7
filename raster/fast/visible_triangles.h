// The triangles that a tile shows: their numbers, texel by texel, and their planes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "raster/fast/kernels.h"
#include "raster/fast/tile_samples.h"

namespace etalon::raster::fast {

struct VisibleTriangles {
  /// Per texel, rows kTileSize apart: the triangle's number, from 1 in the order of submission; 0 where none. A vector may begin anywhere.
  alignas(64) std::uint32_t number[kTileSize * kTileSize + kTileSlack];
  // By number; what 0 stands for is there too, so that kernels may read it.
  std::vector<std::uint32_t> id;
  std::vector<const Draw*> draw;
  std::unique_ptr<double[]> planes;  ///< layout.stride() each; none where the layout has no planes
  bool perspective = false;          ///< some Q is not 1

  /// Everything but planes, from samples of the triangles `ids`.
  void find(const DrawList& list, const Tile& tile, const TileSamples& samples, std::span<const std::uint32_t> ids, const Kernels& kernels);
  void make_planes(const DrawList& list, const Frame& frame, const Tile& tile, const PlaneLayout& layout, const Kernels& kernels);
};

}  // namespace etalon::raster::fast
