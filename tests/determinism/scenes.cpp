#include "tests/determinism/scenes.h"

#include <memory>
#include <utility>

#include "core/base/rng.h"
#include "core/draw/scene.h"
#include "core/procedural/head.h"
#include "core/procedural/swirl.h"

namespace etalon::test {
namespace {

constexpr int kFrameSize = 96;
constexpr PixelFormat kColorFormats[] = {{ChannelType::unorm8, 4}, {ChannelType::srgb8, 4},   {ChannelType::unorm16, 3},
                                         {ChannelType::half, 4},   {ChannelType::float32, 2}, {ChannelType::unorm8, 1}};

std::shared_ptr<const Image> noise_image(int width, int height, PixelFormat format, Rng& rng) {
  auto image = std::make_shared<Image>(width, height, format);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < format.channels; ++c) {
        if (format.type == ChannelType::float32)
          image->channels<float>(x, y)[c] = rng.uniform(0, 1);
        else if (format.type == ChannelType::unorm16)
          image->channels<std::uint16_t>(x, y)[c] = static_cast<std::uint16_t>(rng.below(65536));
        else
          image->channels<std::uint8_t>(x, y)[c] = static_cast<std::uint8_t>(rng.below(256));
      }
    }
  }
  return image;
}

// Every content a target can have, colours in all formats, ids, margins.
std::vector<TargetSpec> all_targets() {
  std::vector<TargetSpec> targets;
  for (const PixelFormat format : kColorFormats) targets.push_back({TargetContent::color, format, {0.25f, 0.5f, 0.75f, 1}});
  targets.push_back({TargetContent::triangle_id, kR32ui});
  targets.push_back({TargetContent::barycentrics, {ChannelType::float32, 3}});
  targets.push_back({TargetContent::barycentrics, {ChannelType::half, 3}});
  targets.push_back({TargetContent::coordinate, kRg32f});
  targets.push_back({TargetContent::coordinate, {ChannelType::unorm16, 2}});
  targets.push_back({TargetContent::depth, kR32f});
  targets.push_back({TargetContent::margins, kRgba32f});
  targets.push_back({TargetContent::bound_terms, kRg32f});
  return targets;
}

// Positions on a coarse lattice meet edges, centres and each other often; w on few values mixes affine and perspective triangles.
RasterVertex random_vertex(Rng& rng, int subtexel_bits) {
  const std::int64_t reach = std::int64_t{kFrameSize + 16} << subtexel_bits;
  const std::int64_t step = rng.coin() ? std::int64_t{1} << (subtexel_bits - 1) : 1;
  RasterVertex vertex;
  vertex.x = static_cast<std::int32_t>(rng.between(-(std::int64_t{16} << subtexel_bits), reach) / step * step);
  vertex.y = static_cast<std::int32_t>(rng.between(-(std::int64_t{16} << subtexel_bits), reach) / step * step);
  vertex.z = rng.uniform(0, 1);
  vertex.w = rng.coin() ? 1.0f : rng.uniform(0.25f, 4);
  // Braces: between parentheses compilers choose the order of the calls.
  vertex.uv = Vec2f{rng.uniform(-1.5f, 2.5f), rng.uniform(-1.5f, 2.5f)};
  vertex.color = Vec4f{rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0, 1)};
  return vertex;
}

NamedScene random_scene(std::uint64_t seed) {
  Rng rng(seed);
  NamedScene scene{"random " + std::to_string(seed), {}, {kFrameSize, kFrameSize, 64, {}, all_targets()}};
  RasterState& state = scene.frame.state;
  static constexpr int kBits[] = {1, 4, 8, 8, 12, 16};
  state.subtexel_bits = kBits[rng.below(6)];
  state.fill_rule = static_cast<FillRule>(rng.below(4));
  state.half_rounding = static_cast<HalfRounding>(rng.below(2));
  state.cull = static_cast<CullMode>(rng.below(3));
  state.depth_test = rng.below(4) != 0;

  DrawList& list = scene.list;
  list.images = {noise_image(32, 32, kRgba8, rng), noise_image(29, 17, {ChannelType::srgb8, 3}, rng), noise_image(16, 16, kRgba32f, rng),
                 noise_image(31, 8, {ChannelType::unorm16, 2}, rng), noise_image(20, 20, kRg32f, rng)};
  for (int i = 0; i < 40; ++i) list.vertices.push_back(random_vertex(rng, state.subtexel_bits));
  const auto random_sampler = [&] {
    return Sampler{static_cast<Filter>(rng.below(2)), static_cast<Wrap>(rng.below(3)), static_cast<Wrap>(rng.below(3))};
  };
  for (std::uint32_t d = 0; d < 6; ++d) {
    Draw draw{.first_triangle = 4 * d, .triangle_count = 4, .shading = static_cast<Shading>(d % 3)};
    if (draw.shading != Shading::vertex_color) draw.texture = static_cast<std::uint32_t>(rng.below(3)), draw.sampler = random_sampler();
    if (draw.shading == Shading::indexed)
      draw.indexing_map = 3 + static_cast<std::uint32_t>(rng.below(2)), draw.map_sampler = random_sampler();
    list.draws.push_back(draw);
    for (int t = 0; t < 4; ++t) {
      // Vertices are shared, so triangles have common edges.
      const auto any = [&] { return static_cast<std::uint32_t>(rng.below(list.vertices.size())); };
      list.triangles.push_back({any(), any(), any()});
    }
  }
  return scene;
}

NamedScene model_scene(const procedural::Model& model, const std::string& view, Filter filter) {
  NamedScene scene{
      model.name + ", " + view, {}, {192, 160, 2048, {}, {{TargetContent::color, kRgb8}, {TargetContent::triangle_id, kR32ui}}}};
  const Material material{.texture = std::make_shared<Image>(model.texture), .sampler = {filter, Wrap::repeat, Wrap::repeat}};
  const Camera camera = named_view(view, bounding_box(model.mesh), scene.frame.width, scene.frame.height);
  scene.list = make_scene(model.mesh, {material}, camera, scene.frame);
  return scene;
}

}  // namespace

std::vector<NamedScene> determinism_scenes() {
  std::vector<NamedScene> scenes;
  for (std::uint64_t seed = 0; seed < 24; ++seed) scenes.push_back(random_scene(seed));
  const procedural::Model head = procedural::make_head({.faces = 2000, .texture_size = 128});
  const procedural::Model swirl = procedural::make_swirl({.faces = 800, .texture_size = 128});
  scenes.push_back(model_scene(head, "front", Filter::nearest));
  scenes.push_back(model_scene(head, "7/24", Filter::linear));
  scenes.push_back(model_scene(swirl, "fit", Filter::nearest));
  return scenes;
}

}  // namespace etalon::test
