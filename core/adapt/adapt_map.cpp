#include "core/adapt/adapt_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "core/draw/scene.h"

namespace etalon::adapt {
namespace {

// Packs that are handed to the renderer together.
constexpr std::size_t kPacksAtOnce = 16;

void add_cells(const RingCells& cells, AdaptDirection direction, int width, int height, const RasterState& state, MapPass& pass) {
  const bool forward = direction == AdaptDirection::to_before;
  const auto first = static_cast<std::uint32_t>(pass.vertices.size());
  for (const CellNode& node : cells.nodes) {
    const Vec2f& at = forward ? node.after : node.before;
    RasterVertex v;
    v.x = snap(static_cast<double>(at.x) * width, state), v.y = snap(static_cast<double>(at.y) * height, state);
    v.uv = forward ? node.before : node.after;
    pass.vertices.push_back(v);
  }
  std::for_each(cells.cells.rbegin(), cells.cells.rend(), [&](const auto& cell) {
    pass.triangles.push_back({first + cell[0], first + cell[1], first + cell[2]});
  });
}

// Around the texel's centre and no other's: what lies at all three corners lies at the centre.
void add_texel(const GutterTexel& texel, const RasterState& state, MapPass& pass) {
  const auto first = static_cast<std::uint32_t>(pass.vertices.size());
  for (const Vec2d& corner : {Vec2d(0, 0), Vec2d(1, 0), Vec2d(0.5, 1)}) {
    RasterVertex v;
    v.x = snap(texel.x + corner.x, state), v.y = snap(texel.y + corner.y, state);
    v.uv = texel.uv;
    pass.vertices.push_back(v);
  }
  pass.triangles.push_back({first, first + 1, first + 2});
}

}  // namespace

MapPass cell_pass(const AdaptSequence& sequence, std::span<const std::uint32_t> splits, AdaptDirection direction, int width, int height,
                  const RasterState& state, const GutterPlan* gutter) {
  MapPass pass;
  std::vector<ChartCells> charts;
  for (const std::uint32_t split : splits) {
    sequence.read(split, charts);
    for (const ChartCells& chart : charts) add_cells(chart.cells, direction, width, height, state, pass);
    if (gutter != nullptr)
      for (const GutterTexel& texel : gutter->of_split(split)) add_texel(texel, state, pass);
    pass.group_ends.push_back(static_cast<std::uint32_t>(pass.triangles.size()));
  }
  return pass;
}

AdaptCounts adapt_map(Renderer& renderer, const AdaptSequence& sequence, std::size_t from, std::size_t to, Image& map,
                      const AdaptOptions& options) {
  if (!renderer.supports({.content = TargetContent::color, .format = map.format()}))
    throw UnavailableError(fmt::format("adapting a map: {} does not draw {}", renderer.name(), to_string(map.format())));
  const AdaptDirection direction = to < from ? AdaptDirection::to_before : AdaptDirection::to_after;
  GutterPlan plan;
  AdaptCounts counts;
  if (options.gutter != nullptr) {
    const Gutter& gutter = *options.gutter;
    ETALON_CHECK(gutter.level() == from && gutter.width() == map.width() && gutter.height() == map.height(), "gutter: level and size");
    plan = options.gutter->go_to(sequence, to);
    counts.gutter = plan.texels.size(), counts.uncovered = plan.uncovered, counts.doubled = plan.doubled;
  }
  const GutterPlan* const gutter = options.gutter != nullptr ? &plan : nullptr;
  const auto packs = pack_splits(sequence, from, to, map.width(), map.height(), pack_reach(gutter != nullptr));
  const MapState state{options.filter, renderer.supported_state({})};
  const std::unique_ptr<ResidentMap> resident = renderer.make_map(map, state);
  std::vector<MapPass> passes;
  for (const std::vector<std::uint32_t>& pack : packs) {
    passes.push_back(cell_pass(sequence, pack, direction, map.width(), map.height(), state.raster, gutter));
    counts.adaptations += pack.size(), ++counts.packs;
    if (passes.size() < kPacksAtOnce && counts.packs < packs.size()) continue;
    resident->apply(passes);
    passes.clear();
    if (options.progress) options.progress(counts.packs, packs.size());
  }
  map = resident->read_back();
  counts.texels = resident->texels_written();
  return counts;
}

}  // namespace etalon::adapt
