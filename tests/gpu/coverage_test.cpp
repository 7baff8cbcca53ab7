// llvmpipe covers exactly the samples that int64 edge functions do, once vertices lie on its grid and nothing leaves the viewport.
#include <algorithm>

#include <doctest/doctest.h>

#include "tests/gpu/gl_fixture.h"

using namespace etalon;
using namespace etalon::gpu;
using namespace etalon::gpu::test;

namespace {

/// How a random triangle's vertices are laid.
struct Layout {
  int spread_texel;         ///< vertices lie within this distance of a random centre
  int center_margin_texel;  ///< centres may lie this far outside the frame
  int step_subtexel;        ///< positions are multiples of this: 128 puts many samples on edges and vertices
  bool perspective;
};

RasterVertex random_vertex(std::int64_t cx, std::int64_t cy, const Layout& layout, Rng& rng) {
  const std::int64_t spread = std::int64_t{layout.spread_texel} * 256;
  const auto place = [&](std::int64_t center) {
    return static_cast<std::int32_t>((center + rng.between(-spread, spread)) / layout.step_subtexel * layout.step_subtexel);
  };
  RasterVertex v;
  v.x = place(cx);
  v.y = place(cy);
  v.z = static_cast<float>(rng.unit());
  v.w = layout.perspective ? rng.uniform(0.3f, 3.6f) : 1.0f;
  return v;
}

DrawList random_triangles(std::size_t count, const Frame& frame, const Layout& layout, Rng& rng) {
  std::vector<RasterVertex> vertices;
  const std::int64_t margin = std::int64_t{layout.center_margin_texel} * 256;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t cx = rng.between(-margin, frame.width * std::int64_t{256} + margin);
    const std::int64_t cy = rng.between(-margin, frame.height * std::int64_t{256} + margin);
    for (int k = 0; k < 3; ++k) vertices.push_back(random_vertex(cx, cy, layout, rng));
  }
  return triangle_list(std::move(vertices));
}

std::size_t count_bad(GlRenderer& renderer, Frame frame, const Layout& layout, std::size_t lists, std::size_t triangles_per_list,
                      Rng& rng) {
  frame.state.depth_test = false;  // the later triangle wins, so that order needs no depth
  std::size_t bad = 0;
  for (std::size_t i = 0; i < lists; ++i) {
    const DrawList list = random_triangles(triangles_per_list, frame, layout, rng);
    bad += count_different(renderer.render(list, frame).front(), reference_ids(list, frame));
  }
  return bad;
}

}  // namespace

TEST_CASE("random on-grid triangles cover what the edge functions cover") {
  GlRenderer* renderer = renderer_or_skip("gpu coverage");
  if (renderer == nullptr) return;
  REQUIRE(renderer->device().fill_rule == FillRule::left_ymin);
  Rng rng(1);
  const Frame square = frame_of(*renderer, 512, 512, 256, {kIdTarget});
  const Frame odd = frame_of(*renderer, 301, 177, 2048, {kIdTarget});
  const Frame tiny = frame_of(*renderer, 1, 1, 0, {kIdTarget});
  // Small triangles seldom hide each other: most of their edges stay visible.
  CHECK(count_bad(*renderer, square, {12, 0, 1, false}, 8, 500, rng) == 0);
  CHECK(count_bad(*renderer, square, {12, 0, 128, false}, 8, 500, rng) == 0);
  CHECK(count_bad(*renderer, square, {200, 0, 1, false}, 40, 8, rng) == 0);
  CHECK(count_bad(*renderer, square, {12, 0, 1, true}, 8, 500, rng) == 0);
  CHECK(count_bad(*renderer, odd, {9, 0, 1, false}, 4, 300, rng) == 0);
  CHECK(count_bad(*renderer, odd, {9, 0, 128, true}, 4, 300, rng) == 0);
  CHECK(count_bad(*renderer, odd, {1000, 500, 1, true}, 16, 6, rng) == 0);
  CHECK(count_bad(*renderer, tiny, {0, 0, 1, false}, 1, 4, rng) == 0);
}

TEST_CASE("triangles that reach to the edge of the guard are not clipped") {
  GlRenderer* renderer = renderer_or_skip("gpu guard");
  if (renderer == nullptr) return;
  Rng rng(2);
  // 128 + 2 · 64 = 256 is a power of two: the guard ends exactly at the viewport's border.
  Frame frame = frame_of(*renderer, 128, 128, 64, {kIdTarget});
  CHECK(count_bad(*renderer, frame, {0, 64, 1, false}, 1, 1, rng) == 0);
  frame.state.depth_test = false;
  const auto corner = [](double x, double y, float w) {
    RasterVertex v = vertex_at(x, y);
    v.w = w;
    return v;
  };
  for (const float w : {1.0f, 0.7f}) {
    const DrawList list =
        triangle_list({corner(-64, -64, 1), corner(192, -64, w), corner(192, 192, 1), corner(-64, -64, 1), corner(-63.5, 192, 1),
                       corner(37.25, -64, w), corner(192, 3.5, 1), corner(-64, 120, w), corner(-64, 119, 1)});
    const std::vector<std::uint32_t> expected = reference_ids(list, frame);
    CHECK(std::count(expected.begin(), expected.end(), 2u) > 0);
    CHECK(count_different(renderer->render(list, frame).front(), expected) == 0);
  }
  // Far out: 16 texels of frame in a guard that fills the largest viewport.
  Frame far_out = frame_of(*renderer, 16, 16, 8184, {kIdTarget});
  CHECK(count_bad(*renderer, far_out, {8000, 16, 1, false}, 8, 12, rng) == 0);
  CHECK(count_bad(*renderer, far_out, {8000, 16, 1, true}, 8, 12, rng) == 0);
}

TEST_CASE("vertices at depth 0 and 1 are not clipped, and interpolated depths stay between") {
  GlRenderer* renderer = renderer_or_skip("gpu depth clamp");
  if (renderer == nullptr) return;
  Rng rng(4);
  Frame frame = frame_of(*renderer, 128, 128, 64, {kIdTarget, kDepthTarget});
  frame.state.depth_test = false;
  DrawList list = random_triangles(2000, frame, {12, 0, 1, true}, rng);
  for (RasterVertex& v : list.vertices) v.z = rng.coin() ? 1.0f : 0.0f;
  const std::vector<Image> images = renderer->render(list, frame);
  CHECK(count_different(images[0], reference_ids(list, frame)) == 0);
  const auto* depths = images[1].channels<float>(0, 0);
  CHECK(std::all_of(depths, depths + images[1].texel_count(), [](float z) { return z >= 0 && z <= 1; }));
}

TEST_CASE("zero area draws nothing and culling drops one orientation") {
  GlRenderer* renderer = renderer_or_skip("gpu culling");
  if (renderer == nullptr) return;
  Frame frame = frame_of(*renderer, 16, 16, 8, {kIdTarget});
  const DrawList flat = triangle_list({vertex_at(0, 0), vertex_at(8, 8), vertex_at(16, 16)});
  CHECK(count_different(renderer->render(flat, frame).front(), std::vector<std::uint32_t>(256, kNoTriangle)) == 0);

  const DrawList counter_clockwise = triangle_list({vertex_at(-8, -8), vertex_at(24, -8), vertex_at(8, 24)});
  const DrawList clockwise = triangle_list({vertex_at(-8, -8), vertex_at(8, 24), vertex_at(24, -8)});
  const auto is_drawn = [&](const DrawList& list, CullMode cull) {
    frame.state.cull = cull;
    return *renderer->render(list, frame).front().channels<std::uint32_t>(8, 8) == 0;
  };
  CHECK(is_drawn(counter_clockwise, CullMode::none));
  CHECK(is_drawn(clockwise, CullMode::none));
  CHECK(is_drawn(counter_clockwise, CullMode::clockwise));
  CHECK_FALSE(is_drawn(clockwise, CullMode::clockwise));
  CHECK_FALSE(is_drawn(counter_clockwise, CullMode::counter_clockwise));
  CHECK(is_drawn(clockwise, CullMode::counter_clockwise));
}

TEST_CASE("coarser sub-texel grids are drawn as they are") {
  GlRenderer* renderer = renderer_or_skip("gpu sub-texel bits");
  if (renderer == nullptr) return;
  Rng rng(3);
  for (const int bits : {1, 4, 7}) {
    Frame frame = frame_of(*renderer, 64, 48, 32, {kIdTarget});
    frame.state.subtexel_bits = bits;
    frame.state.depth_test = false;
    std::vector<RasterVertex> vertices;
    for (int i = 0; i < 600; ++i) {
      RasterVertex v;
      v.x = static_cast<std::int32_t>(rng.between(-32 << bits, 96 << bits));
      v.y = static_cast<std::int32_t>(rng.between(-32 << bits, 80 << bits));
      vertices.push_back(v);
    }
    const DrawList list = triangle_list(std::move(vertices));
    CHECK(count_different(renderer->render(list, frame).front(), reference_ids(list, frame)) == 0);
  }
}

TEST_CASE("ids of a list longer than one vertex buffer") {
  GlRenderer* renderer = renderer_or_skip("gpu long list");
  if (renderer == nullptr) return;
  // One small triangle around the centre of each texel of 512 × 400: 204,800 triangles, four buffers.
  const Frame frame = frame_of(*renderer, 512, 400, 2, {kIdTarget});
  std::vector<RasterVertex> vertices;
  std::vector<std::uint32_t> expected;
  for (int row = 0; row < frame.height; ++row) {
    for (int column = 0; column < frame.width; ++column) {
      expected.push_back(static_cast<std::uint32_t>(expected.size()));
      vertices.push_back(vertex_at(column + 0.25, row + 0.25));
      vertices.push_back(vertex_at(column + 0.875, row + 0.25));
      vertices.push_back(vertex_at(column + 0.5, row + 0.875));
    }
  }
  DrawList list = triangle_list(std::move(vertices));
  CHECK(count_different(renderer->render(list, frame).front(), expected) == 0);
  // Draws that end inside a buffer, at its border, that span buffers, and an empty one.
  list.draws.clear();
  std::uint32_t next = 0;
  for (const std::uint32_t count : {10u, 65526u, 0u, 1u, 131071u, 8192u}) {
    list.draws.push_back({.first_triangle = next, .triangle_count = count});
    next += count;
  }
  REQUIRE(next == list.triangles.size());
  CHECK(count_different(renderer->render(list, frame).front(), expected) == 0);
}
