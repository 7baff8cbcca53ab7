#include "raster/cpu_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/float_environment.h"
#include "core/base/parallel.h"
#include "raster/cpu_map.h"
#include "raster/fast/tile_shader.h"
#include "raster/tile_bins.h"
#include "raster/visibility.h"

namespace etalon::raster {
namespace {

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

// Per target, a tile's row where nothing is drawn.
std::vector<std::vector<std::byte>> clear_rows(const Frame& frame) {
  std::vector<std::vector<std::byte>> rows;
  for (const TargetSpec& target : frame.targets) rows.emplace_back(static_cast<std::size_t>(bytes_per_texel(target.format) * kTileSize));
  std::vector<std::byte*> texels(rows.size());
  for (int column = 0; column < kTileSize; ++column) {
    for (std::size_t n = 0; n < rows.size(); ++n) texels[n] = rows[n].data() + column * bytes_per_texel(frame.targets[n].format);
    store_clear(frame, texels.data());
  }
  return rows;
}

}  // namespace

std::string CpuRenderer::name() const { return fmt::format("etalon cpu, contract {}", kRasterContractVersion); }

std::vector<Image> CpuRenderer::render(const DrawList& list, const Frame& frame) {
  std::vector<Image> images;
  render_into(list, frame, images);
  return images;
}

std::unique_ptr<ResidentMap> CpuRenderer::make_map(Image map, const MapState& state) {
  return evaluation_ == Evaluation::vectorised ? make_cpu_map(std::move(map), state) : make_rendered_map(*this, std::move(map), state);
}

void CpuRenderer::render_into(const DrawList& list, const Frame& frame, std::vector<Image>& images) {
  const DefaultFloatEnvironment environment;
  validate(list, frame);
  images.resize(frame.targets.size());
  for (std::size_t n = 0; n < images.size(); ++n) {
    const PixelFormat format = frame.targets[n].format;
    if (images[n].width() != frame.width || images[n].height() != frame.height || images[n].format() != format)
      images[n] = Image(frame.width, frame.height, format);
  }
  const bool keep_runner_up = frame.state.depth_test && std::any_of(frame.targets.begin(), frame.targets.end(), [](const TargetSpec& t) {
                                return t.content == TargetContent::margins;
                              });

  const TileBins bins(list, frame);
  std::vector<EvaluationCounters> per_tile(bins.tiles());
  if (evaluation_ == Evaluation::vectorised) {
    const fast::RunContext context = {
        list, frame, *fast::kernels_for(simd_level()), fast::plane_layout(list, frame), fast::largest_texels(list), clear_rows(frame)};
    parallel_for(bins.tiles(), [&](std::size_t n) { per_tile[n] = fast::draw_tile(context, bins.tile(n), bins.triangles(n), images); });
  } else {
    parallel_for(bins.tiles(), [&](std::size_t n) {
      const Tile tile = bins.tile(n);
      TileVisibility visible;
      resolve_visibility(list, frame, tile, bins.triangles(n), keep_runner_up, visible);
      per_tile[n] = shade_tile(list, frame, tile, visible, evaluation_, images);
    });
  }
  counters_ = {};
  for (const EvaluationCounters& c : per_tile) counters_ += c;
}

}  // namespace etalon::raster
