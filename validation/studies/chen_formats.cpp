#include "validation/studies/chen_formats.h"

#include <algorithm>

#include "core/adapt/adapt_map.h"
#include "core/adapt/map_format.h"
#include "core/draw/scene.h"
#include "validation/verify/pictures.h"

namespace etalon::validation {

std::vector<ChenFormat> adapt_in_formats(Renderer& renderer, const adapt::AdaptSequence& sequence, const adapt::ChartBorders& borders,
                                         std::size_t level, const Image& analytic) {
  const int width = analytic.width(), height = analytic.height();
  std::vector<ChenFormat> formats;
  for (const ChannelType type : {ChannelType::float32, ChannelType::half, ChannelType::unorm16, ChannelType::unorm8}) {
    ChenFormat format;
    format.type = type;
    Image map = adapt::identity_map(width, height, type);
    adapt::Gutter gutter(borders, width, height);
    (void)adapt::adapt_map(renderer, sequence, sequence.size(), level, map, {.gutter = &gutter});
    format.unnamed = adapt::unnamed_texels(width, height, type);
    format.errors = texel_errors(map, gutter, [&](int x, int y) { return adapt::map_coordinate(analytic, x, y); });
    format.map = std::make_shared<const Image>(std::move(map));
    formats.push_back(std::move(format));
  }
  return formats;
}

Image parameterization_picture(Renderer& renderer, const Mesh& mesh, const std::shared_ptr<const Image>& texture, int size) {
  constexpr double kLine = 0.55;  // texels to each side of an edge
  Frame frame{.width = size, .height = size, .guard = 2048, .state = {}, .targets = {}};
  frame.state.depth_test = false;
  frame.state = renderer.supported_state(frame.state);
  frame.targets = {{TargetContent::color, kRgb8, {0.93f, 0.93f, 0.93f, 1}},
                   {TargetContent::margins, kRgba32f, {}},
                   {TargetContent::triangle_id, kR32ui, {}}};
  Mesh plain = mesh;
  plain.face_materials.clear();
  const Material material{.texture = texture, .sampler = {Filter::linear, Wrap::clamp, Wrap::clamp}};
  std::vector<Image> drawn = renderer.render(make_uv_scene(plain, {material}, frame), frame);
  Image picture = picture_of(drawn[0]);
  const double per_texel = 1 << frame.state.subtexel_bits;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      if (*drawn[2].channels<std::uint32_t>(x, y) == kNoTriangle) continue;
      const double distance = drawn[1].channels<float>(x, y)[0] / per_texel, keep = std::clamp(distance / kLine, 0.25, 1.0);
      for (int k = 0; k < 3; ++k) {
        auto& c = picture.channels<std::uint8_t>(x, y)[k];
        c = static_cast<std::uint8_t>(c * keep + 20 * (1 - keep) + 0.5);
      }
    }
  return picture;
}

}  // namespace etalon::validation
