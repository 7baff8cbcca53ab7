#include "core/adapt/resolve_texture.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "core/base/error.h"

namespace etalon::adapt {

Image resolve_texture(Renderer& renderer, const Image& texture, const Image& map, Filter map_filter) {
  Frame frame{.width = texture.width(), .height = texture.height(), .guard = 0, .state = {}, .targets = {}};
  frame.targets = {{.content = TargetContent::color, .format = texture.format()}};
  frame.state.depth_test = false;
  frame.state = renderer.supported_state(frame.state);
  if (!renderer.supports(frame.targets[0]))
    throw UnavailableError(fmt::format("a texture through a map: {} does not draw {}", renderer.name(), to_string(texture.format())));
  DrawList list;
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    RasterVertex v;
    v.x = (x * texture.width()) << frame.state.subtexel_bits, v.y = (y * texture.height()) << frame.state.subtexel_bits;
    v.uv = {static_cast<float>(x), static_cast<float>(y)};
    list.vertices.push_back(v);
  }
  list.triangles = {{0, 1, 2}, {0, 2, 3}};
  Draw draw;
  draw.triangle_count = 2, draw.shading = Shading::indexed;
  draw.texture = 0, draw.sampler = {Filter::linear, Wrap::clamp, Wrap::clamp};
  draw.indexing_map = 1, draw.map_sampler = {map_filter, Wrap::clamp, Wrap::clamp};
  list.draws = {draw};
  // The list only lives while the images do.
  const auto unowned = [](const Image& image) { return std::shared_ptr<const Image>(std::shared_ptr<const Image>(), &image); };
  list.images = {unowned(texture), unowned(map)};
  return renderer.render(list, frame).front();
}

}  // namespace etalon::adapt
