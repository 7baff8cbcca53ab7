#include "core/adapt/resolve_texture.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/adapt/map_format.h"
#include "core/base/error.h"
#include "core/base/rng.h"
#include "raster/cpu_renderer.h"

using namespace etalon;
using namespace etalon::adapt;

namespace {

Image noise(int width, int height, PixelFormat format) {
  Image image(width, height, format);
  Rng rng(4);
  for (std::byte& b : image.bytes()) b = static_cast<std::byte>(rng.below(256));
  return image;
}

}  // namespace

TEST_CASE("resolve texture: through the identity map a texture is itself, whatever the map's size") {
  raster::CpuRenderer renderer;
  const Image texture = noise(48, 32, kRgb8);
  // A float32 map rounds centres by 2^-25: far below the half step of 8 bits between any two texels.
  CHECK(resolve_texture(renderer, texture, identity_map(48, 32)) == texture);
  CHECK(resolve_texture(renderer, texture, identity_map(48, 32), Filter::nearest) == texture);
  // A larger map whose texels are inside the texture's: linear lookups between them are as exact, but at the rim, where they are clamped.
  const Image large = resolve_texture(renderer, texture, identity_map(192, 128));
  CHECK(large == texture);
}

TEST_CASE("resolve texture: a shifted map shifts every texture") {
  raster::CpuRenderer renderer;
  Image map = identity_map(32, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) map.channels<float>(x, y)[0] += 4 / 32.0f;
  for (const PixelFormat format : {kRgb8, kRgba8, PixelFormat{ChannelType::unorm16, 1}}) {
    const Image texture = noise(32, 32, format), shifted = resolve_texture(renderer, texture, map);
    REQUIRE(shifted.format() == format);
    const auto texel_bytes = static_cast<std::size_t>(bytes_per_texel(format));
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x)
        REQUIRE(std::equal(shifted.texel(x, y), shifted.texel(x, y) + texel_bytes, texture.texel(std::min(x + 4, 31), y)));
  }
}

TEST_CASE("resolve texture: integers are refused") {
  raster::CpuRenderer renderer;
  CHECK_THROWS_AS((void)resolve_texture(renderer, noise(8, 8, kR32ui), identity_map(8, 8)), InputError);
}
