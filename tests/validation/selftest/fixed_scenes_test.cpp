// Do the fixed scenes visit what they promise? A setting that no scene has is a setting that the one hash does not see.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "raster/cpu_renderer.h"
#include "validation/selftest/fixed_scenes.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

const std::vector<SceneFamily>& families() {
  static const std::vector<SceneFamily> kFamilies = fixed_scenes();
  return kFamilies;
}

template <class Visit>
void for_each_scene(const Visit& visit) {
  for (const SceneFamily& family : families())
    for (const FixedScene& scene : family.scenes) visit(scene);
}

}  // namespace

TEST_CASE("every scene is valid, and something is drawn in nearly every one") {
  std::size_t scenes = 0, empty = 0;
  raster::CpuRenderer renderer(raster::Evaluation::filtered);
  for_each_scene([&](const FixedScene& scene) {
    CAPTURE(scene.name);
    FixedScene ids = scene;
    ids.frame.targets = {{TargetContent::triangle_id, kR32ui}};
    const Image image = renderer.render(ids.list, ids.frame).front();
    std::size_t covered = 0;
    for (int j = 0; j < image.height(); ++j)
      for (int i = 0; i < image.width(); ++i) covered += *image.channels<std::uint32_t>(i, j) != kNoTriangle ? 1 : 0;
    ++scenes;
    empty += covered == 0 ? 1 : 0;
  });
  CHECK(scenes > 1000);
  CHECK(empty * 50 < scenes);
}

TEST_CASE("names are unique within a family") {
  for (const SceneFamily& family : families()) {
    std::set<std::string> names;
    for (const FixedScene& scene : family.scenes) names.insert(scene.name);
    CAPTURE(family.name);
    CHECK(names.size() == family.scenes.size());
  }
}

TEST_CASE("every state, target and frame size") {
  std::set<std::tuple<int, FillRule, bool>> grids;
  std::set<CullMode> culls;
  std::set<std::tuple<TargetContent, ChannelType, int>> targets;
  std::set<HalfRounding> half_roundings;
  std::set<int> widths, heights;
  for_each_scene([&](const FixedScene& scene) {
    const RasterState& state = scene.frame.state;
    grids.insert({state.subtexel_bits, state.fill_rule, state.depth_test});
    culls.insert(state.cull);
    for (const TargetSpec& target : scene.frame.targets) {
      targets.insert({target.content, target.format.type, target.format.channels});
      if (target.format.type == ChannelType::half) half_roundings.insert(state.half_rounding);
    }
    widths.insert(scene.frame.width), heights.insert(scene.frame.height);
  });
  CHECK(grids.size() == 16 * 4 * 2);
  CHECK(culls.size() == 3);
  CHECK(half_roundings.size() == 2);
  CHECK((widths.contains(1) && widths.contains(16384) && heights.contains(1) && heights.contains(16384)));
  for (const ChannelType type : {ChannelType::unorm8, ChannelType::srgb8, ChannelType::unorm16, ChannelType::half, ChannelType::float32}) {
    for (int channels = 1; channels <= 4; ++channels) CHECK(targets.contains({TargetContent::color, type, channels}));
    CHECK(targets.contains({TargetContent::barycentrics, type, 3}));
    CHECK(targets.contains({TargetContent::coordinate, type, 2}));
  }
  for (const TargetContent content : {TargetContent::triangle_id, TargetContent::depth, TargetContent::margins, TargetContent::bound_terms})
    CHECK(std::any_of(targets.begin(), targets.end(), [&](const auto& target) { return std::get<0>(target) == content; }));
}

TEST_CASE("every lookup: filters, wraps, formats of textures and maps, affine and perspective") {
  std::set<std::tuple<Filter, Wrap, Wrap>> samplers;
  std::set<std::tuple<Filter, ChannelType, int>> textures, maps;
  std::set<std::tuple<Shading, Filter, Filter, bool>> kinds;
  for_each_scene([&](const FixedScene& scene) {
    for (const Draw& draw : scene.list.draws) {
      const RasterVertex& first = scene.list.vertices[scene.list.triangles[draw.first_triangle][0]];
      const RasterVertex& second = scene.list.vertices[scene.list.triangles[draw.first_triangle][1]];
      kinds.insert({draw.shading, draw.sampler.filter, draw.map_sampler.filter, first.w == second.w});
      if (draw.shading == Shading::vertex_color) continue;
      samplers.insert({draw.sampler.filter, draw.sampler.wrap_u, draw.sampler.wrap_v});
      const PixelFormat format = scene.list.images[draw.texture]->format();
      textures.insert({draw.sampler.filter, format.type, format.channels});
      if (draw.shading != Shading::indexed) continue;
      const PixelFormat map = scene.list.images[draw.indexing_map]->format();
      maps.insert({draw.map_sampler.filter, map.type, map.channels});
    }
  });
  CHECK(samplers.size() == 2 * 3 * 3);
  CHECK(textures.size() == 2 * 5 * 4);
  CHECK(maps.size() == 2 * 5 * 3);
  CHECK(kinds.size() == (1 + 2 + 4) * 2);
}

TEST_CASE("the vector kernels decide most of what they are there for") {
  raster::CpuRenderer renderer;
  std::uint64_t values = 0, scalar = 0;
  for_each_scene([&](const FixedScene& scene) {
    (void)renderer.render(scene.list, scene.frame);
    values += renderer.counters().values, scalar += renderer.counters().scalar;
  });
  MESSAGE(values << " values, " << scalar << " of them not by the vector kernels");
  CHECK(scalar < values / 2);
}
