#include "validation/probe/lookup_sheet.h"

#include "core/base/error.h"

namespace etalon::validation {
namespace {

// The frame as two triangles, corners on texel corners: on every grid.
DrawList sheet_list(Draw draw, std::vector<std::shared_ptr<const Image>> images, int subtexel_bits) {
  DrawList list;
  const std::int32_t size = kSheetSize << subtexel_bits;
  for (const auto& [x, y] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}})
    list.vertices.push_back({.x = x * size, .y = y * size, .uv = {static_cast<float>(x), static_cast<float>(y)}});
  list.triangles = {{0, 1, 2}, {0, 2, 3}};
  draw.triangle_count = 2;
  list.draws = {draw};
  list.images = std::move(images);
  return list;
}

Image drawn(Renderer& device, const Draw& draw, std::vector<std::shared_ptr<const Image>> images, PixelFormat target) {
  Frame frame;
  frame.width = frame.height = kSheetSize;
  frame.guard = 0;
  frame.state = device.supported_state(frame.state);
  frame.targets = {{.content = TargetContent::color, .format = target}};
  return device.render(sheet_list(draw, std::move(images), frame.state.subtexel_bits), frame).front();
}

}  // namespace

Image look_up(Renderer& device, const std::shared_ptr<const Image>& texture, const Sampler& sampler, const std::vector<Vec2f>& coordinates,
              PixelFormat target) {
  ETALON_CHECK(coordinates.size() <= kSheetLookups, std::to_string(coordinates.size()));
  Image map(kSheetSize, kSheetSize, kRg32f);
  for (std::size_t n = 0; n < coordinates.size(); ++n) {
    map.channels<float>(0, 0)[2 * n] = coordinates[n].x;
    map.channels<float>(0, 0)[2 * n + 1] = coordinates[n].y;
  }
  const Draw draw{.shading = Shading::indexed, .texture = 1, .sampler = sampler, .indexing_map = 0};
  return drawn(device, draw, {std::make_shared<const Image>(std::move(map)), texture}, target);
}

std::vector<float> look_up_floats(Renderer& device, const std::shared_ptr<const Image>& texture, const Sampler& sampler,
                                  const std::vector<Vec2f>& coordinates) {
  const Image image = look_up(device, texture, sampler, coordinates, kR32f);
  const float* first = image.channels<float>(0, 0);
  return {first, first + coordinates.size()};
}

Image store(Renderer& device, const std::vector<float>& values, PixelFormat format) {
  ETALON_CHECK(values.size() <= kSheetLookups, std::to_string(values.size()));
  Image texture(kSheetSize, kSheetSize, kR32f);
  for (std::size_t n = 0; n < values.size(); ++n) texture.channels<float>(0, 0)[n] = values[n];
  return drawn(device, {.shading = Shading::texture, .texture = 0}, {std::make_shared<const Image>(std::move(texture))}, format);
}

}  // namespace etalon::validation
