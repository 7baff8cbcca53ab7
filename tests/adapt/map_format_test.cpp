#include "core/adapt/map_format.h"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>

#include "core/base/error.h"
#include "core/draw/scene.h"
#include "raster/cpu_renderer.h"

using namespace etalon;
using namespace etalon::adapt;

namespace {

constexpr ChannelType kTypes[] = {ChannelType::float32, ChannelType::half, ChannelType::unorm16, ChannelType::unorm8};

// How many texels of a numbered texture do not come back through the identity map: drawn, both lookups nearest.
std::size_t lost_in_drawing(int size, ChannelType type) {
  auto numbered = std::make_shared<Image>(size, size, kR32f);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) numbered->channels<float>(x, y)[0] = static_cast<float>(y * size + x);
  DrawList list;
  const auto corner = [&](int x, int y) {
    list.vertices.push_back({.x = x * size * 256, .y = y * size * 256, .uv = {static_cast<float>(x), static_cast<float>(y)}});
  };
  corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1);
  list.triangles = {{0, 1, 2}, {0, 2, 3}};
  list.images = {numbered, std::make_shared<const Image>(identity_map(size, size, type))};
  list.draws = {{.triangle_count = 2, .shading = Shading::indexed, .texture = 0, .indexing_map = 1}};
  TargetSpec target;
  target.format = kR32f;
  raster::CpuRenderer renderer;
  const Image drawn = renderer.render(list, {.width = size, .height = size, .guard = 0, .targets = {target}}).front();
  std::size_t lost = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) lost += drawn.channels<float>(x, y)[0] != numbered->channels<float>(x, y)[0] ? 1 : 0;
  return lost;
}

}  // namespace

TEST_CASE("map format: what the identity map cannot name is what the renderer does not give back") {
  for (const ChannelType type : kTypes)
    for (const int size : {1, 7, 255, 256, 257, 300, 512, 1024}) {
      CAPTURE(to_string(type));
      CAPTURE(size);
      CHECK(unnamed_texels(size, size, type) == lost_in_drawing(size, type));
    }
}

TEST_CASE("map format: the sizes up to which each type names every texel") {
  // Of the sizes 256 to 8192. Columns lost: 256 of 512 and 768 of 1024 for unorm8, 511 of 2048 and 1535 of 4096 for half.
  const auto lost_columns = [](int size, ChannelType type) { return unnamed_texels(size, 1, type); };
  for (const int size : {256, 512, 1024, 2048, 4096, 8192}) {
    CAPTURE(size);
    CHECK(lost_columns(size, ChannelType::float32) == 0);
    CHECK(lost_columns(size, ChannelType::unorm16) == 0);
    CHECK((lost_columns(size, ChannelType::half) == 0) == (size <= 1024));
    CHECK((lost_columns(size, ChannelType::unorm8) == 0) == (size <= 256));
  }
  CHECK(lost_columns(512, ChannelType::unorm8) == 256);
  CHECK(lost_columns(1024, ChannelType::unorm8) == 768);
  CHECK(lost_columns(2048, ChannelType::half) == 511);
  CHECK(lost_columns(4096, ChannelType::half) == 1535);
  // Both directions: 512 rows of which half are lost.
  CHECK(unnamed_texels(256, 512, ChannelType::unorm8) == 256 * 256);
}

TEST_CASE("map format: every texel holds the number nearest to its centre") {
  for (const ChannelType type : kTypes) {
    const int width = 300, height = 77;
    const Image map = identity_map(width, height, type);
    CHECK(map.format() == PixelFormat{type, 2});
    // Half the spacing of the numbers below 1: 2^-25, 2^-12, 1/(2·65535), 1/(2·255); float and half are finer where smaller.
    const double half_step = type == ChannelType::float32   ? 0x1p-25
                             : type == ChannelType::half    ? 0x1p-12
                             : type == ChannelType::unorm16 ? 0.5 / 65535
                                                            : 0.5 / 255;
    for (int y = 0; y < height; y += 3)
      for (int x = 0; x < width; ++x) {
        const Vec2d at = map_coordinate(map, x, y);
        REQUIRE(std::abs(at.x - (x + 0.5) / width) <= half_step * (1 + 0x1p-40));
        REQUIRE(std::abs(at.y - (y + 0.5) / height) <= half_step * (1 + 0x1p-40));
      }
  }
}

TEST_CASE("map format: other types are refused") {
  CHECK_THROWS_AS((void)identity_map(16, 16, ChannelType::srgb8), InputError);
  CHECK_THROWS_AS((void)identity_map(16, 16, ChannelType::uint32), InputError);
  CHECK_THROWS_AS((void)unnamed_texels(16, 16, ChannelType::uint32), InputError);
}
