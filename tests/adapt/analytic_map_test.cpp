#include "core/adapt/analytic_map.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/adapt/adapt_map.h"
#include "core/adapt/chain_index.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "raster/cpu_renderer.h"
#include "tests/adapt/level_fixture.h"

using namespace etalon;
using namespace etalon::adapt;

namespace {

// The slow direct way: every cell of every split for every point.
std::size_t differing_points(const AdaptSequence& sequence, std::size_t from, std::size_t to, int along) {
  const ChainIndex index(sequence, from, to);
  std::size_t differing = 0;
  for (int y = 0; y < along; ++y)
    for (int x = 0; x < along; ++x) {
      const Vec2d p((x + 0.5) / along, (y + 0.5) / along), slow = sequence.follow(p, from, to), fast = index.follow(p);
      differing += slow.x != fast.x || slow.y != fast.y ? 1 : 0;
    }
  return differing;
}

}  // namespace

TEST_CASE("chain index: the same doubles as asking every cell of every split") {
  for (test::ModelLevels* model : {&test::swirl(), &test::head()}) {
    const std::size_t fine = model->sequence.size();
    CHECK(differing_points(model->sequence, 0, fine, 30) == 0);
    CHECK(differing_points(model->sequence, fine, 0, 30) == 0);
    CHECK(differing_points(model->sequence, fine / 3, fine / 2, 60) == 0);
    CHECK(differing_points(model->sequence, fine / 2, fine / 2, 10) == 0);
  }
}

TEST_CASE("chain index: corners of [0, 1]² and nodes of cells, where buckets and cells meet") {
  const AdaptSequence& sequence = test::head().sequence;
  const ChainIndex up(sequence, 0, sequence.size());
  for (const Vec2d& p : {Vec2d(0, 0), Vec2d(1, 0), Vec2d(1, 1), Vec2d(0, 1), Vec2d(0.5, 0.5)}) {
    const Vec2d slow = sequence.follow(p, 0, sequence.size()), fast = up.follow(p);
    CHECK(slow.x == fast.x);
    CHECK(slow.y == fast.y);
  }
  for (std::size_t n = 0; n < sequence.size(); n += 211)
    for (const ChartCells& chart : sequence.split(n))
      for (const CellNode& node : chart.cells.nodes) {
        const Vec2d p(node.after), slow = sequence.follow(p, 0, sequence.size()), fast = up.follow(p);
        REQUIRE(slow.x == fast.x);
        REQUIRE(slow.y == fast.y);
      }
}

TEST_CASE("analytic map: down and up again within 2^-30 texel, every texel of a map") {
  const AdaptSequence& sequence = test::swirl().sequence;
  const ChainIndex down(sequence, sequence.size(), 0), up(sequence, 0, sequence.size());
  constexpr int kSize = 512;
  double most = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Vec2d p((x + 0.5) / kSize, (y + 0.5) / kSize), q = up.follow(down.follow(p));
      most = std::max(most, std::hypot(q.x - p.x, q.y - p.y) * kSize);
    }
  MESSAGE("largest error in texels: " << most << " = 2^" << std::log2(most));
  CHECK(most <= 0x1p-30);
}

TEST_CASE("analytic map: what the chain gives, in every format, the same bytes for every thread count") {
  const AdaptSequence& sequence = test::head().sequence;
  for (const ChannelType type : {ChannelType::float32, ChannelType::half, ChannelType::unorm16, ChannelType::unorm8}) {
    set_thread_count(1);
    const Image one = analytic_map(sequence, 0, 200, 100, type);
    set_thread_count(3);
    int reported = 0;
    const Image three = analytic_map(sequence, 0, 200, 100, type, [&](int done, int total) {
      CHECK(total == 100);
      CHECK(done > reported);
      reported = done;
    });
    set_thread_count(0);
    CHECK(reported == 100);
    CHECK(one == three);
    const double step = type == ChannelType::float32   ? 0x1p-24
                        : type == ChannelType::half    ? 0x1p-11
                        : type == ChannelType::unorm16 ? 1.0 / 65535
                                                       : 1.0 / 255;
    for (int y = 0; y < 100; y += 9)
      for (int x = 0; x < 200; x += 7) {
        const Vec2d truth = sequence.follow({(x + 0.5) / 200, (y + 0.5) / 100}, 0, sequence.size()), at = map_coordinate(one, x, y);
        REQUIRE(std::abs(at.x - truth.x) <= step / 2 * (1 + 0x1p-40));
        REQUIRE(std::abs(at.y - truth.y) <= step / 2 * (1 + 0x1p-40));
      }
  }
  CHECK(analytic_map(sequence, sequence.size(), 64, 64) == identity_map(64, 64));
  CHECK_THROWS_AS((void)analytic_map(sequence, 0, 64, 64, ChannelType::srgb8), InputError);
}

TEST_CASE("analytic map with gutter: the chain in charts, beside their borders what the adapted map's gutter holds") {
  constexpr int kSize = 128;
  test::ModelLevels& head = test::head();
  const ChartBorders borders(head.mesh);
  Gutter gutter(borders, kSize, kSize);
  raster::CpuRenderer renderer;
  Image adapted = identity_map(kSize, kSize);
  (void)adapt_map(renderer, head.sequence, head.sequence.size(), 0, adapted, {.filter = Filter::linear, .gutter = &gutter, .progress = {}});
  const Image chain = analytic_map(head.sequence, 0, kSize, kSize), map = analytic_with_gutter(head.sequence, 0, adapted, gutter);
  std::size_t in_charts = 0, moved_beside = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Vec2d at = map_coordinate(map, x, y), by_chain = map_coordinate(chain, x, y), by_splits = map_coordinate(adapted, x, y);
      const Vec2d expected = gutter.in_chart(x, y) ? by_chain : by_splits;
      REQUIRE(at.x == expected.x);
      REQUIRE(at.y == expected.y);
      in_charts += gutter.in_chart(x, y) ? 1 : 0;
      moved_beside += !gutter.in_chart(x, y) && (at.x != by_chain.x || at.y != by_chain.y) ? 1 : 0;
    }
  CHECK(in_charts > 0);
  CHECK(moved_beside > 0);
}
