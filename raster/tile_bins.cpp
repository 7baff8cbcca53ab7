#include "raster/tile_bins.h"

#include <algorithm>

#include "core/base/parallel.h"

namespace etalon::raster {
namespace {

// Tiles of a bounding box; empty where it holds no sample of the frame.
struct TileBox {
  std::int16_t x0, x1, y0, y1;
};
constexpr TileBox kNoTiles = {0, -1, 0, -1};

struct Grid {
  int bits, width, height;
  [[nodiscard]] TileBox box(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c) const {
    // Positions are within ±2^30 sub-texels (docs/contract.md#input).
    const std::int32_t half = std::int32_t{1} << (bits - 1);
    const auto first = [&](std::int32_t lo) { return std::max((lo + half - 1) >> bits, 0); };  // ceil(lo − ½)
    const auto last = [&](std::int32_t hi, int size) { return std::min((hi - half) >> bits, size - 1); };
    const std::int32_t i0 = first(std::min({a.x, b.x, c.x})), i1 = last(std::max({a.x, b.x, c.x}), width);
    const std::int32_t j0 = first(std::min({a.y, b.y, c.y})), j1 = last(std::max({a.y, b.y, c.y}), height);
    if (i0 > i1 || j0 > j1) return kNoTiles;
    const auto tile = [](std::int32_t texel) { return static_cast<std::int16_t>(texel / kTileSize); };
    return {tile(i0), tile(i1), tile(j0), tile(j1)};
  }
};

// Blocks are a function of the list alone, so the order of ids in a tile is too. Few enough for a counter per block and tile.
constexpr std::size_t kMostBlocks = 32, kLeastTriangles = 8192;

}  // namespace

TileBins::TileBins(const DrawList& list, const Frame& frame)
    : columns_((frame.width + kTileSize - 1) / kTileSize), width_(frame.width), height_(frame.height) {
  const auto tiles = static_cast<std::size_t>(columns_) * static_cast<std::size_t>((frame.height + kTileSize - 1) / kTileSize);
  const std::size_t triangles = list.triangles.size();
  const std::size_t grain = std::max(kLeastTriangles, (triangles + kMostBlocks - 1) / kMostBlocks);
  const std::size_t blocks = (triangles + grain - 1) / grain;
  const Grid grid = {frame.state.subtexel_bits, frame.width, frame.height};
  const auto boxes = std::make_unique_for_overwrite<TileBox[]>(triangles);
  std::vector<std::size_t> next(blocks * tiles, 0);  // first how many, then where the block's next id of a tile goes

  const auto for_tiles = [this](const TileBox& box, auto&& body) {
    for (int y = box.y0; y <= box.y1; ++y)
      for (int x = box.x0; x <= box.x1; ++x)
        body(static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x));
  };
  parallel_for(blocks, [&](std::size_t block) {
    std::size_t* const count = next.data() + block * tiles;
    for (std::size_t t = block * grain; t < std::min(triangles, (block + 1) * grain); ++t) {
      const auto& corner = list.triangles[t];
      boxes[t] = grid.box(list.vertices[corner[0]], list.vertices[corner[1]], list.vertices[corner[2]]);
      for_tiles(boxes[t], [&](std::size_t tile) { ++count[tile]; });
    }
  });
  first_.resize(tiles + 1);
  std::size_t total = 0;
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    first_[tile] = total;
    for (std::size_t block = 0; block < blocks; ++block) {
      const std::size_t count = next[block * tiles + tile];
      next[block * tiles + tile] = total;
      total += count;
    }
  }
  first_[tiles] = total;
  ids_ = std::make_unique_for_overwrite<std::uint32_t[]>(total);
  parallel_for(blocks, [&](std::size_t block) {
    std::size_t* const at = next.data() + block * tiles;
    for (std::size_t t = block * grain; t < std::min(triangles, (block + 1) * grain); ++t)
      for_tiles(boxes[t], [&](std::size_t tile) { ids_[at[tile]++] = static_cast<std::uint32_t>(t); });
  });
}

Tile TileBins::tile(std::size_t n) const {
  const int x0 = static_cast<int>(n % static_cast<std::size_t>(columns_)) * kTileSize;
  const int y0 = static_cast<int>(n / static_cast<std::size_t>(columns_)) * kTileSize;
  return {x0, y0, std::min(kTileSize, width_ - x0), std::min(kTileSize, height_ - y0)};
}

}  // namespace etalon::raster
