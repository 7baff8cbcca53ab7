#include <doctest/doctest.h>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "raster/sample_query.h"
#include "tests/raster/draw_helpers.h"

using namespace etalon;
using namespace etalon::test;

namespace {

constexpr std::uint32_t kNone = kNoTriangle;

std::vector<std::uint32_t> drawn(const std::vector<RasterVertex>& vertices, const Frame& frame) {
  raster::CpuRenderer renderer;
  return ids(renderer.render(list_of(vertices), frame)[0]);
}

}  // namespace

TEST_CASE("fill rules: a square from centre to centre owns the sides its rule names") {
  // Centres of texels 0 and 2 are its corners: the rules keep columns 0,1 or 1,2 and rows 0,1 or 1,2.
  const auto square = quad(0.5, 0.5, 2.5, 2.5);
  const auto covered = [&](FillRule rule) {
    Frame frame = frame_of(3, 3, kIdOnly);
    frame.state.fill_rule = rule;
    std::vector<int> result;
    for (const std::uint32_t id : drawn(square, frame)) result.push_back(id == kNone ? 0 : 1);
    return result;
  };
  CHECK(covered(FillRule::left_ymin) == std::vector<int>{1, 1, 0, 1, 1, 0, 0, 0, 0});
  CHECK(covered(FillRule::left_ymax) == std::vector<int>{0, 0, 0, 1, 1, 0, 1, 1, 0});
  CHECK(covered(FillRule::right_ymin) == std::vector<int>{0, 1, 1, 0, 1, 1, 0, 0, 0});
  CHECK(covered(FillRule::right_ymax) == std::vector<int>{0, 0, 0, 0, 1, 1, 0, 1, 1});
}

TEST_CASE("the diagonal of a square belongs to one triangle, and orientation does not matter") {
  const Frame frame = frame_of(2, 2, kIdOnly);
  // The diagonal runs up and to the right through both centres: it is a left edge of the lower-right triangle only where dy < 0.
  const auto ccw = drawn({at(0, 0), at(2, 0), at(2, 2), at(0, 0), at(2, 2), at(0, 2)}, frame);
  const auto cw = drawn({at(0, 0), at(2, 2), at(2, 0), at(0, 0), at(0, 2), at(2, 2)}, frame);
  CHECK(ccw == cw);
  CHECK(ccw == std::vector<std::uint32_t>{0, 0, 1, 0});
}

TEST_CASE("culling is decided before the orientation is repaired") {
  Frame frame = frame_of(2, 2, kIdOnly);
  const std::vector<RasterVertex> ccw = {at(0, 0), at(2, 0), at(0, 2)}, cw = {at(0, 0), at(0, 2), at(2, 0)};
  frame.state.cull = CullMode::clockwise;
  CHECK(drawn(ccw, frame)[0] == 0);
  CHECK(drawn(cw, frame)[0] == kNone);
  frame.state.cull = CullMode::counter_clockwise;
  CHECK(drawn(ccw, frame)[0] == kNone);
  CHECK(drawn(cw, frame)[0] == 0);
}

TEST_CASE("nothing is drawn by zero area, or between the samples") {
  const Frame frame = frame_of(4, 4, kIdOnly);
  for (const std::uint32_t id : drawn({at(0, 0), at(2, 2), at(4, 4)}, frame)) CHECK(id == kNone);
  for (const std::uint32_t id : drawn({at(1.5625, 1.5625), at(1.9375, 1.5625), at(1.75, 1.9375)}, frame)) CHECK(id == kNone);
}

TEST_CASE("a fan over a jittered ring covers each sample exactly once, in every rule and at 16 sub-texel bits") {
  Rng rng(5);
  for (int round = 0; round < 60; ++round) {
    Frame frame = frame_of(32, 32, kIdOnly);
    frame.state.subtexel_bits = round % 2 == 0 ? 8 : 16;
    frame.state.fill_rule = static_cast<FillRule>(round % 4);
    frame.state.depth_test = false;
    const std::int32_t one = 1 << frame.state.subtexel_bits;
    // A square ring of lattice points, every third on a sample centre; its fan around an inner point.
    std::vector<RasterVertex> ring;
    const auto point = [&](std::int64_t x, std::int64_t y) {
      RasterVertex v;
      v.x = static_cast<std::int32_t>(x), v.y = static_cast<std::int32_t>(y);
      return v;
    };
    const std::int64_t lo = 2 * one + one / 2, hi = 28 * one + one / 2;
    for (int n = 0; n < 8; ++n) ring.push_back(point(lo + (hi - lo) * n / 8, lo));
    for (int n = 0; n < 8; ++n) ring.push_back(point(hi, lo + (hi - lo) * n / 8));
    for (int n = 0; n < 8; ++n) ring.push_back(point(hi - (hi - lo) * n / 8, hi));
    for (int n = 0; n < 8; ++n) ring.push_back(point(lo, hi - (hi - lo) * n / 8));
    const RasterVertex middle =
        round % 3 == 0 ? point(16 * one + one / 2, 16 * one + one / 2) : point(rng.between(lo, hi), rng.between(lo, hi));
    std::vector<RasterVertex> fan;
    for (std::size_t n = 0; n < ring.size(); ++n) {
      fan.push_back(middle), fan.push_back(ring[n]), fan.push_back(ring[(n + 1) % ring.size()]);
    }
    const DrawList list = list_of(fan);
    const raster::SampleQuery query(list, frame);
    int total = 0;
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 32; ++i) {
        int hits = 0;
        for (std::uint32_t t = 0; t < list.triangles.size(); ++t) hits += query.covers(t, i, j) ? 1 : 0;
        REQUIRE(hits <= 1);
        total += hits;
      }
    // 27 × 27 centres lie in the closed square; each rule owns one vertical and one horizontal side: 26 × 26.
    CHECK(total == 26 * 26);
  }
}
