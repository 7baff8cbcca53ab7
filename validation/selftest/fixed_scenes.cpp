#include "validation/selftest/fixed_scenes.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "core/draw/scene.h"
#include "core/procedural/head.h"
#include "core/procedural/swirl.h"
#include "validation/selftest/geometry_scenes.h"
#include "validation/selftest/scene_parts.h"
#include "validation/selftest/value_scenes.h"

namespace etalon::validation {
namespace {

RasterState random_state(Rng& rng) {
  static constexpr std::array kBits{1, 4, 8, 8, 12, 16};
  RasterState state;
  state.subtexel_bits = kBits[rng.below(kBits.size())];
  state.fill_rule = static_cast<FillRule>(rng.below(4));
  state.half_rounding = static_cast<HalfRounding>(rng.below(2));
  state.cull = static_cast<CullMode>(rng.below(3));
  state.depth_test = rng.below(4) != 0;
  return state;
}

// Six draws of triangles over shared vertices: colours, textures, indexed lookups in turn.
void add_random_draws(FixedScene& scene, Rng& rng, int vertex_count, std::uint32_t triangles_per_draw) {
  DrawList& list = scene.list;
  list.images = {noise_image(32, 32, kRgba8, rng),
                 noise_image(29, 17, {ChannelType::srgb8, 3}, rng),
                 noise_image(16, 16, kRgba32f, rng),
                 noise_image(9, 12, {ChannelType::half, 4}, rng),
                 noise_image(31, 8, {ChannelType::unorm16, 2}, rng),
                 noise_image(20, 20, kRg32f, rng)};
  // Positions on a coarse lattice meet edges, centres and each other often; w on few values mixes affine and perspective triangles.
  for (int n = 0; n < vertex_count; ++n) list.vertices.push_back(random_vertex(rng, scene.frame, {.on_lattice = rng.coin()}));
  for (std::uint32_t d = 0; d < 6; ++d) {
    Draw& draw = open_draw(list, static_cast<Shading>(d % 3));
    if (draw.shading != Shading::vertex_color) draw.texture = static_cast<std::uint32_t>(rng.below(4)), draw.sampler = random_sampler(rng);
    if (draw.shading == Shading::indexed)
      draw.indexing_map = 4 + static_cast<std::uint32_t>(rng.below(2)), draw.map_sampler = random_sampler(rng);
    for (std::uint32_t t = 0; t < triangles_per_draw; ++t) {
      const auto any = [&] { return static_cast<std::uint32_t>(rng.below(list.vertices.size())); };
      list.triangles.push_back({any(), any(), any()});
    }
    draw.triangle_count = triangles_per_draw;
  }
}

// One to three of all there are, a colour always.
std::vector<TargetSpec> few_targets(Rng& rng) {
  const std::vector<TargetSpec> all = all_targets();
  std::vector<TargetSpec> targets{
      {TargetContent::color, {kNumberTypes[rng.below(5)], static_cast<int>(rng.between(1, 4))}, {0.25f, 0.5f, 0.75f, 1}}};
  for (std::uint64_t n = rng.below(3); n > 0; --n) targets.push_back(all[rng.below(all.size())]);
  return targets;
}

SceneFamily random_scenes() {
  SceneFamily family{"random", {}};
  for (std::uint64_t seed = 0; seed < 48; ++seed) {
    Rng rng(seed);
    FixedScene scene{fmt::format("random {}", seed), {}, {83, 71, 64, random_state(rng), {}}};
    scene.frame.targets = seed % 4 == 0 ? all_targets() : few_targets(rng);
    add_random_draws(scene, rng, 40, 4);
    family.scenes.push_back(std::move(scene));
  }
  return family;
}

FixedScene model_scene(const procedural::Model& model, const std::string& view, Filter filter) {
  FixedScene scene{fmt::format("{}, {}", model.name, view), {}, {}};
  scene.frame = {193, 157, 2048, {}, {{TargetContent::color, kRgb8}, {TargetContent::triangle_id, kR32ui}}};
  const Material material{.texture = std::make_shared<Image>(model.texture), .sampler = {filter, Wrap::repeat, Wrap::repeat}};
  const Camera camera = named_view(view, bounding_box(model.mesh), scene.frame.width, scene.frame.height);
  scene.list = make_scene(model.mesh, {material}, camera, scene.frame);
  return scene;
}

SceneFamily model_scenes() {
  const procedural::Model head = procedural::make_head({.faces = 800, .texture_size = 64});
  const procedural::Model swirl = procedural::make_swirl({.faces = 800, .texture_size = 64});
  return {
      "models",
      {model_scene(head, "front", Filter::nearest), model_scene(head, "7/24", Filter::linear), model_scene(swirl, "fit", Filter::nearest)}};
}

}  // namespace

std::vector<SceneFamily> fixed_scenes() {
  return {shading_scenes(), texture_scenes(), wrap_scenes(), extreme_value_scenes(), target_scenes(), grid_scenes(),   far_scenes(),
          tiny_scenes(),    sliver_scenes(),  tie_scenes(),  size_scenes(),          pass_scenes(),   random_scenes(), model_scenes()};
}

FixedScene judged_scene(std::uint64_t seed) {
  Rng rng(seed ^ 0x6A75646765ull);
  FixedScene scene{fmt::format("judged {}", seed), {}, {}};
  const int width = static_cast<int>(rng.between(1, 48));
  const int height = static_cast<int>(rng.between(1, 40));
  scene.frame = {width, height, 64, random_state(rng), few_targets(rng)};
  add_random_draws(scene, rng, 14, static_cast<std::uint32_t>(rng.between(1, 2)));
  return scene;
}

}  // namespace etalon::validation
