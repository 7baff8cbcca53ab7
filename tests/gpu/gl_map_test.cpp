#include "gpu/gl_map.h"

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/support/map_passes.h"

using namespace etalon;
using namespace etalon::gpu;
using namespace etalon::gpu::test;

TEST_CASE("a map on the device holds what rendering each pass and copying what was drawn gives") {
  GlRenderer* renderer = renderer_or_skip("gpu resident map");
  if (renderer == nullptr) return;
  Rng rng(1);
  for (const PixelFormat format : {kRg32f, kRgba8, kRgb8, PixelFormat{ChannelType::unorm16, 2}, PixelFormat{ChannelType::half, 2}})
    for (const Filter filter : {Filter::nearest, Filter::linear}) {
      const MapState state{filter, renderer->supported_state({})};
      const Image start = random_image(211, 150, format, rng);
      std::vector<MapPass> passes;
      for (int n = 0; n < 6; ++n) passes.push_back(etalon::test::random_map_pass(rng, 211, 150, state.raster.subtexel_bits));
      const auto rendered = make_rendered_map(*renderer, start, state);
      rendered->apply(passes);
      const Image expected = rendered->read_back();
      CHECK(expected != start);
      const auto map = renderer->make_map(start, state);
      CHECK(map->read_back() == start);
      map->apply(std::span(passes).first(1));  // calls of one, two and three passes
      map->apply(std::span(passes).subspan(1, 2));
      map->apply({});
      map->apply(std::span(passes).subspan(3));
      CHECK(map->read_back() == expected);
    }
}

TEST_CASE("two maps of one renderer and its drawings do not disturb each other") {
  GlRenderer* renderer = renderer_or_skip("gpu resident maps");
  if (renderer == nullptr) return;
  Rng rng(2);
  const MapState state{Filter::nearest, renderer->supported_state({})};
  const Image start_a = random_image(128, 128, kRg32f, rng), start_b = random_image(96, 160, kRgba8, rng);
  std::vector<MapPass> passes;
  for (int n = 0; n < 4; ++n) passes.push_back(etalon::test::random_map_pass(rng, 96, 128, state.raster.subtexel_bits));
  const auto alone = [&](const Image& start) {
    const auto map = renderer->make_map(start, state);
    map->apply(passes);
    return map->read_back();
  };
  const Image expected_a = alone(start_a), expected_b = alone(start_b);
  const auto a = renderer->make_map(start_a, state), b = renderer->make_map(start_b, state);
  const DrawList quad = textured_quad(start_b, 64, 64);
  for (const MapPass& pass : passes) {
    a->apply(std::span(&pass, 1));
    b->apply(std::span(&pass, 1));
    (void)renderer->render(quad, frame_of(*renderer, 64, 64, 0, {kColorTarget}));
  }
  CHECK(a->read_back() == expected_a);
  CHECK(b->read_back() == expected_b);
}

TEST_CASE("a map on the device refuses what no drawing may hold and keeps its texels") {
  GlRenderer* renderer = renderer_or_skip("gpu resident map refusals");
  if (renderer == nullptr) return;
  Rng rng(3);
  const Image start = random_image(32, 32, kRg32f, rng);
  const MapState state{Filter::linear, renderer->supported_state({})};
  const auto map = renderer->make_map(start, state);
  MapPass wrong;
  wrong.vertices = {vertex_at(0, 0), vertex_at(9, 0), vertex_at(0, 9)}, wrong.triangles = {{0, 1, 3}}, wrong.group_ends = {1};
  CHECK_THROWS_AS(map->apply(std::span(&wrong, 1)), InputError);
  CHECK(map->read_back() == start);
  MapPass good = wrong, no_groups = wrong, beyond = wrong;
  good.triangles = {{0, 1, 2}}, no_groups.triangles = beyond.triangles = good.triangles;
  no_groups.group_ends = {}, beyond.group_ends = {2};
  CHECK_THROWS_AS(map->apply(std::span(&no_groups, 1)), InputError);
  CHECK_THROWS_AS(map->apply(std::span(&beyond, 1)), InputError);
  CHECK(map->read_back() == start);
  const std::vector<MapPass> good_and_bad = {good, wrong};  // the map is then as the passes before left it
  CHECK_THROWS_AS(map->apply(good_and_bad), InputError);
  const auto alone = renderer->make_map(start, state);
  alone->apply(std::span(&good, 1));
  CHECK(alone->read_back() != start);
  CHECK(map->read_back() == alone->read_back());
  MapState finer = state;
  finer.raster.subtexel_bits = 16;
  CHECK_THROWS_AS((void)renderer->make_map(start, finer), UnavailableError);
  CHECK_THROWS_AS((void)renderer->make_map(Image(8, 8, kR32ui), state), Error);
}
