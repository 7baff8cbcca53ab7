#include "core/adapt/adapt_map.h"

#include <fmt/format.h>

#include <cstring>
#include <utility>

#include "core/base/error.h"
#include "core/draw/scene.h"

namespace etalon::adapt {
namespace {

void add_cells(const RingCells& cells, AdaptDirection direction, int width, int height, const RasterState& state, DrawList& list) {
  const bool forward = direction == AdaptDirection::to_before;
  const auto first = static_cast<std::uint32_t>(list.vertices.size());
  for (const CellNode& node : cells.nodes) {
    const Vec2f& at = forward ? node.after : node.before;
    RasterVertex v;
    v.x = snap(static_cast<double>(at.x) * width, state), v.y = snap(static_cast<double>(at.y) * height, state);
    v.uv = forward ? node.before : node.after;
    list.vertices.push_back(v);
  }
  for (const auto& cell : cells.cells) list.triangles.push_back({first + cell[0], first + cell[1], first + cell[2]});
}

// Copies the texels that some triangle covers.
std::size_t copy_covered(const Image& color, const Image& ids, Image& map) {
  const auto texel_bytes = static_cast<std::size_t>(bytes_per_texel(map.format()));
  const auto* id = ids.channels<std::uint32_t>(0, 0);
  const std::byte* from = color.bytes().data();
  std::byte* to = map.bytes().data();
  std::size_t copied = 0;
  for (std::size_t n = 0; n < map.texel_count(); ++n) {
    if (id[n] == kNoTriangle) continue;
    std::memcpy(to + n * texel_bytes, from + n * texel_bytes, texel_bytes);
    ++copied;
  }
  return copied;
}

}  // namespace

Image identity_map(int width, int height) {
  Image map(width, height, kRg32f);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      auto* const channels = map.channels<float>(x, y);
      channels[0] = static_cast<float>((x + 0.5) / width), channels[1] = static_cast<float>((y + 0.5) / height);
    }
  return map;
}

DrawList cell_list(const AdaptSequence& sequence, std::span<const std::uint32_t> splits, AdaptDirection direction,
                   std::shared_ptr<const Image> map, Filter filter, const RasterState& state) {
  DrawList list;
  for (const std::uint32_t split : splits)
    for (const ChartCells& chart : sequence.split(split)) add_cells(chart.cells, direction, map->width(), map->height(), state, list);
  Draw draw;
  draw.triangle_count = static_cast<std::uint32_t>(list.triangles.size());
  draw.shading = Shading::texture, draw.texture = 0, draw.sampler = {filter, Wrap::clamp, Wrap::clamp};
  list.draws = {draw};
  list.images = {std::move(map)};
  return list;
}

AdaptCounts adapt_map(Renderer& renderer, const AdaptSequence& sequence, std::size_t from, std::size_t to, Image& map,
                      const AdaptOptions& options) {
  Frame frame{.width = map.width(), .height = map.height(), .guard = 0, .state = {}, .targets = {{}, {}}};
  frame.state.depth_test = false, frame.state.cull = CullMode::none;
  frame.state = renderer.supported_state(frame.state);
  frame.targets[0].content = TargetContent::color, frame.targets[0].format = map.format();
  frame.targets[1].content = TargetContent::triangle_id, frame.targets[1].format = kR32ui;
  for (const TargetSpec& target : frame.targets)
    if (!renderer.supports(target)) throw UnavailableError(fmt::format("adapting a map: {} does not draw its format", renderer.name()));
  const AdaptDirection direction = to < from ? AdaptDirection::to_before : AdaptDirection::to_after;
  const auto packs = pack_splits(sequence, from, to, map.width(), map.height());
  AdaptCounts counts;
  for (const std::vector<std::uint32_t>& pack : packs) {
    // The list only lives while the map does.
    const std::shared_ptr<const Image> unowned(std::shared_ptr<const Image>(), &map);
    const std::vector<Image> drawn = renderer.render(cell_list(sequence, pack, direction, unowned, options.filter, frame.state), frame);
    counts.texels += copy_covered(drawn[0], drawn[1], map);
    counts.adaptations += pack.size(), ++counts.packs;
    if (options.progress) options.progress(counts.packs, packs.size());
  }
  return counts;
}

}  // namespace etalon::adapt
