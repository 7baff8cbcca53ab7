// Targets: depth and its order, storage, clears, barycentrics and coordinates, several in one pass.
#include <algorithm>
#include <array>
#include <bit>

#include <doctest/doctest.h>

#include "tests/gpu/gl_fixture.h"

using namespace etalon;
using namespace etalon::gpu;
using namespace etalon::gpu::test;

namespace {

/// A triangle over the whole 16 × 16 frame of one colour and one depth.
void add_cover(std::vector<RasterVertex>& vertices, float z, Vec4f color = {0, 0, 0, 1}) {
  vertices.push_back(vertex_at(0, 0, {0, 0}, color, z));
  vertices.push_back(vertex_at(32, 0, {0, 0}, color, z));
  vertices.push_back(vertex_at(0, 32, {0, 0}, color, z));
}

bool all_equal(const Image& image, std::uint32_t value) {
  const auto* values = image.channels<std::uint32_t>(0, 0);
  return std::all_of(values, values + image.texel_count(), [&](std::uint32_t a) { return a == value; });
}

bool all_equal(const Image& image, float value) {
  const auto* values = image.channels<float>(0, 0);
  return std::all_of(values, values + image.texel_count(), [&](float a) { return a == value; });
}

}  // namespace

TEST_CASE("nearer wins, equal depths go to the earlier, depth 1 is not drawn") {
  GlRenderer* renderer = renderer_or_skip("gpu depth order");
  if (renderer == nullptr) return;
  // Constant depths that are multiples of 2^-10: the plane has no gradient, and ½·(2z − 1) + ½ is exact.
  Frame frame = frame_of(*renderer, 16, 16, 16, {kIdTarget, kDepthTarget});
  const auto ids_of = [&](const std::vector<float>& depths) {
    std::vector<RasterVertex> vertices;
    for (const float z : depths) add_cover(vertices, z);
    return renderer->render(triangle_list(std::move(vertices)), frame);
  };
  {
    const std::vector<Image> images = ids_of({0.75f, 0.25f, 0.5f, 0.25f});
    CHECK(all_equal(images[0], 1u));
    CHECK(all_equal(images[1], 0.25f));
  }
  {
    const std::vector<Image> images = ids_of({1.0f});
    CHECK(all_equal(images[0], kNoTriangle));
    CHECK(all_equal(images[1], 1.0f));
  }
  {
    const std::vector<Image> images = ids_of({1.0f - 0x1p-10f, 1.0f});
    CHECK(all_equal(images[0], 0u));
    CHECK(all_equal(images[1], 1.0f - 0x1p-10f));
  }
  CHECK(all_equal(ids_of({0x1p-41f})[1], 0.0f));
  frame.state.depth_test = false;
  {
    const std::vector<Image> images = ids_of({0.25f, 0.75f});
    CHECK(all_equal(images[0], 1u));
    CHECK(all_equal(images[1], 0.75f));
  }
  CHECK(all_equal(ids_of({1.0f})[0], 0u));
}

TEST_CASE("random constant depths in random order") {
  GlRenderer* renderer = renderer_or_skip("gpu random depth");
  if (renderer == nullptr) return;
  Rng rng(21);
  const Frame frame = frame_of(*renderer, 96, 64, 64, {kIdTarget, kDepthTarget});
  std::vector<RasterVertex> vertices;
  std::vector<float> depths;
  for (int t = 0; t < 300; ++t) {
    depths.push_back(static_cast<float>(rng.below(64)) / 64);
    for (int k = 0; k < 3; ++k) {
      RasterVertex v;
      v.x = static_cast<std::int32_t>(rng.between(-64 * 256, 160 * 256));
      v.y = static_cast<std::int32_t>(rng.between(-64 * 256, 128 * 256));
      v.z = depths.back();
      vertices.push_back(v);
    }
  }
  // Painted far to near, the later first among equals, the reference needs no depth buffer.
  std::vector<std::uint32_t> order(depths.size());
  for (std::uint32_t t = 0; t < order.size(); ++t) order[t] = t;
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return depths[a] != depths[b] ? depths[a] > depths[b] : a > b; });
  const DrawList list = triangle_list(vertices);
  DrawList painted = list;
  for (std::size_t i = 0; i < order.size(); ++i) painted.triangles[i] = list.triangles[order[i]];
  std::vector<std::uint32_t> expected = reference_ids(painted, frame);
  for (std::uint32_t& id : expected) id = id == kNoTriangle ? id : order[id];

  const std::vector<Image> images = renderer->render(list, frame);
  CHECK(count_different(images[0], expected) == 0);
  int bad = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    bad += images[1].channels<float>(0, 0)[i] != (expected[i] == kNoTriangle ? 1.0f : depths[expected[i]]) ? 1 : 0;
  }
  CHECK(bad == 0);
}

TEST_CASE("storage clamps unorm, keeps float32, and rounds to nearest away from ties") {
  GlRenderer* renderer = renderer_or_skip("gpu storage");
  if (renderer == nullptr) return;
  const Frame frame = frame_of(*renderer, 16, 16, 16,
                               {kColorTarget, {TargetContent::color, {ChannelType::unorm16, 4}, {}}, {TargetContent::color, kRgba32f, {}}});
  // A colour constant on an affine triangle has no gradient, so the device interpolates it without error.
  const Vec4f color{-0.5f, 1.75f, 0.31f, 0.77f};
  std::vector<RasterVertex> vertices;
  add_cover(vertices, 0, color);
  const std::vector<Image> images = renderer->render(triangle_list(std::move(vertices)), frame);
  const std::array<std::uint8_t, 4> unorm8{0, 255, 79, 196};           // 0.31·255 = 79.05, 0.77·255 = 196.35
  const std::array<std::uint16_t, 4> unorm16{0, 65535, 20316, 50462};  // 0.31·65535 = 20315.85, 0.77·65535 = 50461.95
  for (int c = 0; c < 4; ++c) {
    CHECK(images[1].channels<std::uint16_t>(7, 5)[c] == unorm16[static_cast<std::size_t>(c)]);
    CHECK(images[2].channels<float>(7, 5)[c] == color[c]);
    CHECK(images[0].channels<std::uint8_t>(7, 5)[c] == unorm8[static_cast<std::size_t>(c)]);
  }
}

TEST_CASE("clears are stored in every format, and an empty list is only clears") {
  GlRenderer* renderer = renderer_or_skip("gpu clears");
  if (renderer == nullptr) return;
  std::vector<TargetSpec> targets{kIdTarget, kDepthTarget};
  const std::array<float, 4> clear{0.2f, 1.0f, 0.0f, 0.6f};
  for (const ChannelType type : {ChannelType::unorm8, ChannelType::unorm16, ChannelType::half, ChannelType::float32}) {
    targets.push_back({TargetContent::color, {type, 3}, clear});
  }
  Frame frame = frame_of(*renderer, 5, 3, 0, targets);
  const std::vector<Image> images = renderer->render({}, frame);
  CHECK(all_equal(images[0], kNoTriangle));
  CHECK(all_equal(images[1], 1.0f));
  CHECK(images[2].channels<std::uint8_t>(4, 2)[0] == 51);
  CHECK(images[2].channels<std::uint8_t>(4, 2)[1] == 255);
  CHECK(images[2].channels<std::uint8_t>(4, 2)[2] == 0);
  CHECK(images[3].channels<std::uint16_t>(4, 2)[0] == 13107);
  CHECK(images[4].channels<std::uint16_t>(4, 2)[1] == 0x3C00);
  CHECK(images[5].channels<float>(4, 2)[0] == 0.2f);
  // Other clears on kept renderbuffers.
  for (TargetSpec& target : frame.targets) target.clear = {1, 0, 0, 0};
  CHECK(renderer->render({}, frame)[2].channels<std::uint8_t>(0, 0)[0] == 255);
  CHECK(renderer->render({}, frame)[5].channels<float>(0, 0)[1] == 0.0f);
}

TEST_CASE("barycentrics and coordinates belong to the list's vertex order, whatever the orientation") {
  GlRenderer* renderer = renderer_or_skip("gpu barycentrics");
  if (renderer == nullptr) return;
  Frame frame = frame_of(*renderer, 16, 16, 16,
                         {{TargetContent::barycentrics, {ChannelType::float32, 3}, {}}, {TargetContent::coordinate, kRg32f, {}}});
  // Legs of 16 texels: every float32 operation on these numbers is exact.
  const std::array<std::array<double, 2>, 3> corners{{{0, 0}, {16, 0}, {0, 16}}};
  for (const std::array<std::size_t, 3>& order : {std::array<std::size_t, 3>{0, 1, 2}, {2, 1, 0}, {1, 2, 0}}) {
    std::vector<RasterVertex> vertices;
    for (const std::size_t k : order) {
      const auto& p = corners[k];
      vertices.push_back(vertex_at(p[0], p[1], {static_cast<float>(p[0] / 16), static_cast<float>(p[1] / 16)}));
    }
    const std::vector<Image> images = renderer->render(triangle_list(std::move(vertices)), frame);
    const double x = 3.5 / 16;
    const double y = 5.5 / 16;
    const std::array<double, 3> weights{1 - x - y, x, y};
    for (std::size_t i = 0; i < 3; ++i) CHECK(images[0].channels<float>(3, 5)[i] == weights[order[i]]);
    CHECK(images[1].channels<float>(3, 5)[0] == x);
    CHECK(images[1].channels<float>(3, 5)[1] == y);
  }
}

TEST_CASE("attributes enter through canonical()") {
  GlRenderer* renderer = renderer_or_skip("gpu canonical attributes");
  if (renderer == nullptr) return;
  const Frame frame =
      frame_of(*renderer, 16, 16, 16, {{TargetContent::color, kRgba32f, {1, 1, 1, 1}}, {TargetContent::coordinate, kRg32f, {1, 1, 0, 0}}});
  const float below = 0x1.fffffep-41f;
  std::vector<RasterVertex> vertices;
  for (const auto& [x, y] : {std::pair{0, 0}, std::pair{32, 0}, std::pair{0, 32}}) {
    vertices.push_back(vertex_at(x, y, {below, -0.0f}, {-below, 0x1p-40f, -0.0f, -0x1p-40f}));
  }
  const std::vector<Image> images = renderer->render(triangle_list(std::move(vertices)), frame);
  const auto bits = [](const float& value) { return std::bit_cast<std::uint32_t>(value); };
  CHECK(bits(images[0].channels<float>(4, 4)[0]) == 0);
  CHECK(images[0].channels<float>(4, 4)[1] == 0x1p-40f);
  CHECK(bits(images[0].channels<float>(4, 4)[2]) == 0);
  CHECK(images[0].channels<float>(4, 4)[3] == -0x1p-40f);
  CHECK(bits(images[1].channels<float>(4, 4)[0]) == 0);
  CHECK(bits(images[1].channels<float>(4, 4)[1]) == 0);
}

TEST_CASE("a frame of depth alone, and of nothing") {
  GlRenderer* renderer = renderer_or_skip("gpu depth alone");
  if (renderer == nullptr) return;
  std::vector<RasterVertex> vertices;
  add_cover(vertices, 0.125f);
  const DrawList list = triangle_list(std::move(vertices));
  Frame frame = frame_of(*renderer, 16, 16, 16, {kDepthTarget, kDepthTarget});
  const std::vector<Image> images = renderer->render(list, frame);
  REQUIRE(images.size() == 2);
  CHECK(all_equal(images[0], 0.125f));
  CHECK(images[1] == images[0]);
  frame.targets.clear();
  CHECK(renderer->render(list, frame).empty());
}
