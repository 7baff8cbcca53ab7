#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/raster/draw_helpers.h"

using namespace etalon;
using namespace etalon::test;

namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

std::vector<RasterVertex> with_depth(std::vector<RasterVertex> vertices, float z) {
  for (RasterVertex& v : vertices) v.z = z;
  return vertices;
}

std::vector<RasterVertex> operator+(std::vector<RasterVertex> a, const std::vector<RasterVertex>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

TEST_CASE("nearer wins; equal depth goes to the earlier; depth 1 is the background's; without the test the later wins") {
  const std::vector<RasterVertex> t = {at(0, 0), at(4, 0), at(0, 4)};
  const auto winner = [&](float first, float second, bool test) {
    Frame frame = frame_of(1, 1, kIdOnly);
    frame.state.depth_test = test;
    raster::CpuRenderer renderer;
    return ids(renderer.render(list_of(with_depth(t, first) + with_depth(t, second)), frame)[0])[0];
  };
  CHECK(winner(0.5f, 0.25f, true) == 1);
  CHECK(winner(0.25f, 0.5f, true) == 0);
  CHECK(winner(0.5f, 0.5f, true) == 0);
  CHECK(winner(1, 1, true) == kNoTriangle);
  CHECK(winner(0.25f, 0.5f, false) == 1);
}

TEST_CASE("depth is affine although w differs; coordinates and barycentrics are perspective") {
  // Sample (0.5, 0.5) of the triangle (0,0) (2,0) (0,2): affine weights ½, ¼, ¼.
  std::vector<RasterVertex> t = {at(0, 0, 0, 0), at(2, 0, 1, 0), at(0, 2, 0, 1)};
  t[0].w = 1, t[1].w = 2, t[2].w = 4;
  t[0].z = 0, t[1].z = 0.5f, t[2].z = 0.25f;
  raster::CpuRenderer renderer;
  const auto images = renderer.render(list_of(t), frame_of(1, 1,
                                                           {{TargetContent::depth, kR32f},
                                                            {TargetContent::coordinate, kRg32f},
                                                            {TargetContent::barycentrics, {ChannelType::float32, 3}}}));
  CHECK(images[0].channels<float>(0, 0)[0] == 0.1875f);
  // E·w_j·w_k = ½·8, ¼·4, ¼·2 = 4, 1, ½ of 5.5.
  CHECK(images[1].channels<float>(0, 0)[0] == static_cast<float>(2.0 / 11));
  CHECK(images[1].channels<float>(0, 0)[1] == static_cast<float>(1.0 / 11));
  CHECK(images[2].channels<float>(0, 0)[0] == static_cast<float>(8.0 / 11));
}

TEST_CASE("margins: edge, texel borders, depth gap") {
  // A right triangle with legs 8 along the axes; texel (1, 2): centre 1.5, 2.5; distances 1.5, 2.5 and (8 − 4)/√2 texels.
  std::vector<RasterVertex> t = {at(0, 0, 0, 0), at(8, 0, 1, 0), at(0, 8, 0, 1)};
  DrawList list = list_of(with_depth(t, 0.25f) + with_depth(t, 0.75f), Shading::texture);
  list.images = {std::make_shared<Image>(4, 2, kRgba8)};
  list.draws[0].texture = 0;
  const Frame frame = frame_of(8, 8, {{TargetContent::margins, kRgba32f}, {TargetContent::bound_terms, kRg32f}});
  raster::CpuRenderer renderer;
  const auto images = renderer.render(list, frame);
  const float* m = images[0].channels<float>(1, 2);
  CHECK(m[0] == 1.5f * 256);
  CHECK(m[1] == 0.25f);   // u·4 = 0.75
  CHECK(m[2] == 0.375f);  // v·2 = 0.625
  CHECK(m[3] == 0.5f);
  // Texel (3, 3): centre (3.5, 3.5), 1 from the hypotenuse's x + y = 8 along both axes: 1/√2 texel.
  CHECK(images[0].channels<float>(3, 3)[0] == static_cast<float>(256 / std::sqrt(2.0)));
  CHECK(images[1].channels<float>(1, 2)[0] == 0.5f);  // 4/8 in u, 2/8 in v
  CHECK(images[1].channels<float>(1, 2)[1] == 0);
}

TEST_CASE("a fragment at depth 1 is never drawn and so never a runner-up, whatever the order") {
  const std::vector<RasterVertex> t = {at(0, 0), at(4, 0), at(0, 4)};
  const Frame frame = frame_of(1, 1, {{TargetContent::margins, kRgba32f}});
  raster::CpuRenderer renderer;
  CHECK(renderer.render(list_of(with_depth(t, 0.5f) + with_depth(t, 1)), frame)[0].channels<float>(0, 0)[3] == kInf);
  CHECK(renderer.render(list_of(with_depth(t, 1) + with_depth(t, 0.5f)), frame)[0].channels<float>(0, 0)[3] == kInf);
  CHECK(renderer.render(list_of(with_depth(t, 0.5f) + with_depth(t, 0.5f)), frame)[0].channels<float>(0, 0)[3] == 0);
}

TEST_CASE("vertex colours have no texel border; a lone triangle no runner-up") {
  raster::CpuRenderer renderer;
  const Image image = renderer.render(list_of({at(0, 0), at(4, 0), at(0, 4)}), frame_of(1, 1, {{TargetContent::margins, kRgba32f}}))[0];
  const float* m = image.channels<float>(0, 0);
  CHECK(m[0] == 128);
  CHECK(m[1] == kInf);
  CHECK(m[2] == kInf);
  CHECK(m[3] == kInf);
}
