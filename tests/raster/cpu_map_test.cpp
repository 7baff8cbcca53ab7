#include "raster/cpu_map.h"

#include <doctest/doctest.h>

#include <limits>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/raster/draw_helpers.h"
#include "tests/support/map_passes.h"

using namespace etalon;
using namespace etalon::test;

namespace {

Image random_map(Rng& rng, int width, int height, PixelFormat format) {
  Image map(width, height, format);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < format.channels; ++c) {
        if (format.type == ChannelType::float32)
          map.channels<float>(x, y)[c] = rng.uniform(-2, 2);
        else if (format.type == ChannelType::half || format.type == ChannelType::unorm16)
          map.channels<std::uint16_t>(x, y)[c] = static_cast<std::uint16_t>(rng.below(0x7C00));  // halves: finite, not negative
        else
          map.channels<std::uint8_t>(x, y)[c] = static_cast<std::uint8_t>(rng.below(256));
      }
  return map;
}

}  // namespace

TEST_CASE("a resident map holds what rendering each pass and copying what was drawn gives, in all formats, filters and threads") {
  Rng rng(1);
  for (const PixelFormat format : {kRg32f, kRgb8, PixelFormat{ChannelType::unorm16, 2}, PixelFormat{ChannelType::half, 4}})
    for (const Filter filter : {Filter::nearest, Filter::linear}) {
      const int width = 211, height = 150;
      const MapState state{filter, {}};
      raster::CpuRenderer renderer;
      const Image start = random_map(rng, width, height, format);
      std::vector<MapPass> passes;
      for (int n = 0; n < 5; ++n) passes.push_back(random_map_pass(rng, width, height, state.raster.subtexel_bits));
      const auto rendered = make_rendered_map(renderer, start, state);
      rendered->apply(passes);
      const Image expected = rendered->read_back();
      CHECK(expected != start);
      for (const int threads : {1, 2, 7}) {
        set_thread_count(threads);
        const auto map = renderer.make_map(start, state);
        map->apply(std::span(passes).first(2));
        map->apply(std::span(passes).subspan(2));
        CHECK(map->read_back() == expected);
        CHECK(map->texels_written() == rendered->texels_written());
      }
      set_thread_count(0);
    }
}

TEST_CASE("a resident map: of several triangles on a texel the last counts, and the map before the pass is what is looked up") {
  raster::CpuRenderer renderer;
  Rng rng(2);
  const Image start = random_map(rng, 8, 8, kRg32f);
  MapPass pass;
  for (const float v : {0.0f, 1.0f})  // the first quad fetches row 0 for all rows, the second row 7 for the lower half
    for (const RasterVertex& vertex : quad(0, 0, 8, v == 0 ? 8 : 4, {0, v}, {1, v})) pass.vertices.push_back(vertex);
  for (std::uint32_t n = 0; n < 12; n += 3) pass.triangles.push_back({n, n + 1, n + 2});
  pass.group_ends = {4};
  const auto map = renderer.make_map(start, {Filter::nearest, {}});
  map->apply(std::span(&pass, 1));
  const Image result = map->read_back();
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) CHECK(result.channels<float>(x, y)[0] == start.channels<float>(x, y < 4 ? 7 : 0)[0]);
  CHECK(map->texels_written() == 64);
}

TEST_CASE("a resident map refuses what no drawing may hold and keeps its texels") {
  raster::CpuRenderer renderer;
  Rng rng(3);
  const Image start = random_map(rng, 16, 16, kRg32f);
  const auto map = renderer.make_map(start, {Filter::linear, {}});
  MapPass nan, wrong;
  nan.vertices = quad(0, 0, 4, 4), nan.triangles = {{0, 1, 2}}, nan.group_ends = {1};
  nan.vertices[1].uv.x = std::numeric_limits<float>::quiet_NaN();
  wrong.vertices = quad(0, 0, 4, 4), wrong.triangles = {{0, 1, 99}}, wrong.group_ends = {1};
  CHECK_THROWS_AS(map->apply(std::span(&nan, 1)), InputError);
  CHECK_THROWS_AS(map->apply(std::span(&wrong, 1)), InputError);
  MapPass good = wrong, no_groups = wrong, beyond = wrong;
  good.triangles = {{0, 1, 2}}, no_groups.triangles = beyond.triangles = good.triangles;
  no_groups.group_ends = {}, beyond.group_ends = {2};
  CHECK_THROWS_AS(map->apply(std::span(&no_groups, 1)), InputError);
  CHECK_THROWS_AS(map->apply(std::span(&beyond, 1)), InputError);
  const std::vector<MapPass> good_and_bad = {good, wrong};  // the map is then as the passes before left it
  const auto both = renderer.make_map(start, {Filter::linear, {}}), alone = renderer.make_map(start, {Filter::linear, {}});
  CHECK_THROWS_AS(both->apply(good_and_bad), InputError);
  alone->apply(std::span(&good, 1));
  CHECK(alone->read_back() != start);
  CHECK(both->read_back() == alone->read_back());
  const MapPass empty;
  map->apply(std::span(&empty, 1));
  CHECK(map->read_back() == start);
  Image bad = start;
  bad.channels<float>(3, 3)[0] = std::numeric_limits<float>::infinity();
  CHECK_THROWS_AS((void)renderer.make_map(bad, {Filter::linear, {}}), InputError);
}
