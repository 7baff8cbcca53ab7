#include <doctest/doctest.h>

#include "raster/texture.h"
#include "tests/raster/draw_helpers.h"

using namespace etalon;
using namespace etalon::test;

namespace {

std::shared_ptr<Image> ramp(int width, int height) {
  auto image = std::make_shared<Image>(width, height, PixelFormat{ChannelType::unorm8, 2});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      image->channels<std::uint8_t>(x, y)[0] = static_cast<std::uint8_t>(x);
      image->channels<std::uint8_t>(x, y)[1] = static_cast<std::uint8_t>(y);
    }
  return image;
}

Image drawn(DrawList list, const Sampler& sampler, std::shared_ptr<const Image> texture, const Frame& frame) {
  list.images = {std::move(texture)};
  list.draws[0].texture = 0, list.draws[0].sampler = sampler;
  raster::CpuRenderer renderer;
  return renderer.render(list, frame)[0];
}

const std::vector<TargetSpec> kColorRg8 = {{TargetContent::color, {ChannelType::unorm8, 2}}};

}  // namespace

TEST_CASE("wrap acts on the integer index, the mirror without repeating its border index twice") {
  using raster::wrapped;
  const auto row = [](Wrap wrap) {
    std::vector<int> r;
    for (int i = -5; i <= 7; ++i) r.push_back(wrapped(i, 3, wrap));
    return r;
  };
  CHECK(row(Wrap::clamp) == std::vector<int>{0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2, 2});
  CHECK(row(Wrap::repeat) == std::vector<int>{1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1});
  CHECK(row(Wrap::mirrored_repeat) == std::vector<int>{1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1});
  CHECK(wrapped(-(1ll << 40), 3, Wrap::repeat) == 2);
}

TEST_CASE("an identity quad copies a texture byte by byte, nearest and linear") {
  const auto texture = ramp(13, 7);
  const Frame frame = frame_of(13, 7, kColorRg8);
  for (const Filter filter : {Filter::nearest, Filter::linear})
    CHECK(drawn(list_of(quad(0, 0, 13, 7), Shading::texture), {filter, Wrap::clamp, Wrap::clamp}, texture, frame) == *texture);
}

TEST_CASE("a shift by exactly half a texel is all ties: nearest takes the upper texel, linear the even mean") {
  const auto texture = ramp(8, 1);
  const Frame frame = frame_of(8, 1, kColorRg8);
  // u = (x + ½)/8 + 1/16, so u·8 = x + 1 exactly.
  const auto list = list_of(quad(0, 0, 8, 1, {0.0625f, 0}, {1.0625f, 1}), Shading::texture);
  const Image near = drawn(list, {}, texture, frame);
  const Image mean = drawn(list, {Filter::linear, Wrap::clamp, Wrap::clamp}, texture, frame);
  for (int x = 0; x < 8; ++x) {
    CHECK(near.channels<std::uint8_t>(x, 0)[0] == std::min(x + 1, 7));
    const int twice = x + std::min(x + 1, 7);
    CHECK(mean.channels<std::uint8_t>(x, 0)[0] == (twice / 2 + (twice % 2 == 1 && twice / 2 % 2 == 1 ? 1 : 0)));
  }
}

TEST_CASE("an indexing map of texel centres reads the texture through itself") {
  const auto texture = ramp(16, 16);
  auto map = std::make_shared<Image>(16, 16, kRg32f);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      map->channels<float>(x, y)[0] = (15 - x + 0.5f) / 16;  // mirrored in u
      map->channels<float>(x, y)[1] = (y + 0.5f) / 16;
    }
  DrawList list = list_of(quad(0, 0, 16, 16), Shading::indexed);
  list.images = {texture, map};
  list.draws[0].texture = 0, list.draws[0].indexing_map = 1;
  raster::CpuRenderer renderer;
  const Image image = renderer.render(list, frame_of(16, 16, kColorRg8))[0];
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      CHECK(image.channels<std::uint8_t>(x, y)[0] == 15 - x);
      CHECK(image.channels<std::uint8_t>(x, y)[1] == y);
    }
}

TEST_CASE("channels that a texture lacks read 0, 0, 1") {
  const auto texture = ramp(2, 2);
  const Image image = drawn(list_of(quad(0, 0, 2, 2), Shading::texture), {}, texture, frame_of(2, 2, {{TargetContent::color, kRgba8}}));
  CHECK(image.channels<std::uint8_t>(1, 1)[0] == 1);
  CHECK(image.channels<std::uint8_t>(1, 1)[2] == 0);
  CHECK(image.channels<std::uint8_t>(1, 1)[3] == 255);
}
