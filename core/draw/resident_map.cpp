#include "core/draw/resident_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/base/error.h"
#include "core/draw/renderer.h"

namespace etalon {
namespace {

constexpr int kMostGuard = 2048, kMostFrame = 16384;

class RenderedMap : public ResidentMap {
 public:
  RenderedMap(Renderer& renderer, Image map, const MapState& state)
      : renderer_(renderer), state_(state), map_(std::move(map)), frame_(map_frame(map_.width(), map_.height(), map_.format(), state)) {
    frame_.targets.push_back({.content = TargetContent::triangle_id, .format = kR32ui});
  }

  void apply(std::span<const MapPass> passes) override {
    for (const MapPass& pass : passes) {
      validate_groups(pass);
      const std::shared_ptr<const Image> unowned(std::shared_ptr<const Image>(), &map_);  // the list lives shorter than the map
      const std::vector<Image> drawn = renderer_.render(map_pass_list(pass, unowned, state_.filter), frame_);
      written_ += copy_drawn(drawn[0], drawn[1], map_);
    }
  }

  Image read_back() override { return map_; }
  std::uint64_t texels_written() const override { return written_; }

 private:
  Renderer& renderer_;
  MapState state_;
  Image map_;
  Frame frame_;
  std::uint64_t written_ = 0;
};

}  // namespace

void validate_groups(const MapPass& pass) {
  std::size_t last = 0;
  for (const std::uint32_t end : pass.group_ends) {
    if (end < last) throw InputError(fmt::format("map pass: expected group ends that ascend, got {} behind {}", end, last));
    last = end;
  }
  if (last != pass.triangles.size())
    throw InputError(fmt::format("map pass: expected groups that end with triangle {}, got {}", pass.triangles.size(), last));
}

Frame map_frame(int width, int height, PixelFormat format, const MapState& state) {
  const int guard = std::clamp((kMostFrame - std::max(width, height)) / 2, 0, kMostGuard);
  Frame frame{.width = width, .height = height, .guard = guard, .state = state.raster, .targets = {{.format = format}}};
  frame.state.depth_test = false, frame.state.cull = CullMode::none;
  return frame;
}

DrawList map_pass_list(const MapPass& pass, std::shared_ptr<const Image> map, Filter filter) {
  DrawList list{.vertices = pass.vertices, .triangles = pass.triangles, .draws = {}, .images = {std::move(map)}, .source_faces = {}};
  list.draws = {{.triangle_count = static_cast<std::uint32_t>(pass.triangles.size()),
                 .shading = Shading::texture,
                 .texture = 0,
                 .sampler = {filter, Wrap::clamp, Wrap::clamp},
                 .map_sampler = {}}};
  return list;
}

std::uint64_t copy_drawn(const Image& color, const Image& ids, Image& map) {
  ETALON_CHECK(color.format() == map.format() && color.texel_count() == map.texel_count() && ids.texel_count() == map.texel_count(),
               "drawings of the map's size and format");
  const auto texel_bytes = static_cast<std::size_t>(bytes_per_texel(map.format()));
  const auto* const id = ids.channels<std::uint32_t>(0, 0);
  std::uint64_t written = 0;
  for (std::size_t n = 0; n < map.texel_count(); ++n) {
    if (id[n] == kNoTriangle) continue;
    std::memcpy(map.bytes().data() + n * texel_bytes, color.bytes().data() + n * texel_bytes, texel_bytes);
    ++written;
  }
  return written;
}

std::unique_ptr<ResidentMap> make_rendered_map(Renderer& renderer, Image map, const MapState& state) {
  return std::make_unique<RenderedMap>(renderer, std::move(map), state);
}

std::unique_ptr<ResidentMap> Renderer::make_map(Image map, const MapState& state) {
  return make_rendered_map(*this, std::move(map), state);
}

}  // namespace etalon
