#include "raster/cpu_renderer.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/float_environment.h"
#include "core/base/parallel.h"
#include "raster/visibility.h"

namespace etalon::raster {
namespace {

struct TileGrid {
  int columns, rows;
  std::vector<std::vector<std::uint32_t>> bins;  ///< triangle ids per tile, ascending
};

struct TileBox {
  std::int16_t x0 = 0, x1 = -1, y0 = 0, y1 = -1;
};

TileGrid bin_triangles(const DrawList& list, const Frame& frame) {
  std::vector<TileBox> boxes(list.triangles.size());
  parallel_for_blocks(boxes.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto& corner = list.triangles[t];
      const Edges edges = make_edges(list.vertices[corner[0]], list.vertices[corner[1]], list.vertices[corner[2]], frame);
      if (edges.i_min > edges.i_max || edges.j_min > edges.j_max) continue;
      const auto tile = [](int texel) { return static_cast<std::int16_t>(texel / kTileSize); };
      boxes[t] = {tile(edges.i_min), tile(edges.i_max), tile(edges.j_min), tile(edges.j_max)};
    }
  });
  TileGrid grid{(frame.width + kTileSize - 1) / kTileSize, (frame.height + kTileSize - 1) / kTileSize, {}};
  grid.bins.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
  for (std::size_t t = 0; t < boxes.size(); ++t)
    for (int y = boxes[t].y0; y <= boxes[t].y1; ++y)
      for (int x = boxes[t].x0; x <= boxes[t].x1; ++x)
        grid.bins[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(x)].push_back(
            static_cast<std::uint32_t>(t));
  return grid;
}

EvaluationCounters shade_tile(const DrawList& list, const Frame& frame, const Tile& tile, const TileVisibility& visible,
                              Evaluation evaluation, std::vector<Image>& images) {
  EvaluationCounters counters;
  std::vector<std::byte*> texels(images.size());
  std::uint32_t current = kNoTriangle;
  TriangleSetup setup;
  const Draw* draw = nullptr;
  std::size_t at = 0;
  for (int j = tile.y0; j < tile.y0 + tile.height; ++j)
    for (int i = tile.x0; i < tile.x0 + tile.width; ++i, ++at) {
      for (std::size_t n = 0; n < images.size(); ++n) texels[n] = images[n].texel(i, j);
      const std::uint32_t triangle = visible.triangle[at];
      if (triangle == kNoTriangle) {
        store_clear(frame, texels.data());
        continue;
      }
      if (triangle != current) {
        setup = make_triangle_setup(list, triangle, frame);
        draw = &list.draw_of(triangle);
        current = triangle;
      }
      // A difference of two float32 in [0, 1] is exact in double unless their exponents differ by more than 29, where it still rounds to
      // the same float32: then the smaller is below 2^-29 of the larger and float32 keeps 24 bits of a number just below a float32.
      const float gap = visible.runner_up.empty() ? std::numeric_limits<float>::infinity()
                                                  : static_cast<float>(static_cast<double>(visible.runner_up[at]) - visible.depth[at]);
      store_sample(list, *draw, frame, setup, triangle, i, j, {visible.depth[at], gap}, evaluation, texels.data(), counters);
    }
  return counters;
}

}  // namespace

std::string CpuRenderer::name() const { return fmt::format("etalon cpu, contract {}", kRasterContractVersion); }

std::vector<Image> CpuRenderer::render(const DrawList& list, const Frame& frame) {
  const DefaultFloatEnvironment environment;
  validate(list, frame);
  std::vector<Image> images;
  for (const TargetSpec& target : frame.targets) images.emplace_back(frame.width, frame.height, target.format);
  const bool keep_runner_up = frame.state.depth_test && std::any_of(frame.targets.begin(), frame.targets.end(), [](const TargetSpec& t) {
                                return t.content == TargetContent::margins;
                              });

  const TileGrid grid = bin_triangles(list, frame);
  std::vector<EvaluationCounters> per_tile(grid.bins.size());
  parallel_for(grid.bins.size(), [&](std::size_t n) {
    Tile tile;
    tile.x0 = static_cast<int>(n % static_cast<std::size_t>(grid.columns)) * kTileSize;
    tile.y0 = static_cast<int>(n / static_cast<std::size_t>(grid.columns)) * kTileSize;
    tile.width = std::min(kTileSize, frame.width - tile.x0);
    tile.height = std::min(kTileSize, frame.height - tile.y0);
    TileVisibility visible;
    resolve_visibility(list, frame, tile, grid.bins[n], keep_runner_up, visible);
    per_tile[n] = shade_tile(list, frame, tile, visible, evaluation_, images);
  });
  counters_ = {};
  for (const EvaluationCounters& c : per_tile) counters_ += c;
  return images;
}

}  // namespace etalon::raster
