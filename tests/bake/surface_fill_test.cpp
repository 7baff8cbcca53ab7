// Both fills against the judge.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "tests/bake/fill_fixture.h"

using namespace etalon;
using namespace etalon::bake;
using namespace etalon::test;

namespace {

FillCase case_of(std::uint64_t seed) {
  Rng rng(seed);
  Mesh mesh = seed % 4 == 0 ? fins() : relief(static_cast<int>(1 + rng.below(3)), seed, seed % 4 == 1);
  const std::uint64_t spread = 1 + rng.below(4);
  std::vector<double> ratios(mesh.face_count());
  for (double& ratio : ratios) ratio = static_cast<double>(2u << rng.below(spread));
  const std::uint64_t rarity = std::uint64_t{1} << rng.below(8);
  return {std::move(mesh), ratios, seed, rarity, seed % 3 != 0};
}

}  // namespace

TEST_CASE("the exact fill is the judge's to the last texel: distances and, of equally near ones, the lower source") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    const FillCase c = case_of(seed);
    const SurfaceFill fill = fill_exactly(c.problem()), judge = judge_fill(c);
    REQUIRE(fill.distance == judge.distance);
    REQUIRE(fill.source == judge.source);
  }
}

TEST_CASE("the iterative fill: never nearer than the exact one; continuous; sources are hit") {
  std::size_t texels = 0, same = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    const FillCase c = case_of(seed);
    const SurfaceFill fill = fill_iteratively(c.problem()), exact = fill_exactly(c.problem());
    for (std::uint32_t t = 0; t < fill.distance.size(); ++t) {
      REQUIRE(fill.distance[t] >= exact.distance[t]);
      REQUIRE((fill.distance[t] == kNoDistance) == (exact.distance[t] == kNoDistance));
      if (c.colors.is_hit(t)) REQUIRE(fill.source[t] == c.nodes.node_of(t));
      if (fill.source[t] != kNoGroup) REQUIRE(c.colors.is_hit(fill.source[t]));
      REQUIRE(fill.distance[t] == fill.distance[c.nodes.node_of(t)]);
      REQUIRE(fill.source[t] == fill.source[c.nodes.node_of(t)]);
      same += fill.distance[t] == exact.distance[t];
      ++texels;
    }
  }
  CHECK(same * 100 > texels * 98);
}

TEST_CASE("the iterative fill ends at a fixed point: no neighbour's feature, and no texel of the same node, would be nearer") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    const FillCase c = case_of(seed);
    const SurfaceFill fill = fill_iteratively(c.problem());
    CHECK(fill.iterations >= 1);
    for (std::uint32_t f = 0; f < c.mesh.face_count(); ++f) {
      const int size = c.atlas.tiles[f].size;
      std::vector<GridPoint> centers;
      for_each_texel(size, [&](int i, int j) { centers.push_back(c.metric.plane(f).center(i, j)); });
      const auto key = [&](std::uint32_t t) { return std::pair(fill.distance[t], fill.source[t]); };
      const auto from = [&](std::uint32_t t, std::uint32_t feature) {
        const std::uint32_t first = c.nodes.first(f);
        return std::pair(fill.distance[feature] + grid_distance(centers[t - first], centers[feature - first]), fill.source[feature]);
      };
      for_each_texel(size, [&](int i, int j) {
        const std::uint32_t t = c.nodes.texel(f, size, i, j);
        if (fill.source[t] == kNoGroup) return;
        REQUIRE(key(t) == from(t, fill.feature[t]));
        if (c.nodes.group_of(t) != kNoGroup || c.colors.is_hit(t)) REQUIRE(fill.feature[t] == t);
        for (int q = std::max(j - 1, 0); q <= j + 1; ++q)
          for (int p = std::max(i - 1, 0); p <= i + 1 && p + q < size; ++p)
            if (!c.colors.is_hit(t)) REQUIRE(key(t) <= from(t, fill.feature[c.nodes.texel(f, size, p, q)]));
      });
    }
  }
}

TEST_CASE("figures 6 to 8: the nearest of a texel of one triangle is in another, over their edge") {
  // Two right triangles on their hypotenuses, in one plane; one hit deep in each, the second far from the edge.
  Mesh mesh = mesh_of({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {8, 8, 0}}, {{0, 1, 2}, {3, 2, 1}});
  const FillCase near(mesh, {8, 8}, {0});
  const std::uint32_t t2 = near.nodes.texel(0, 8, 3, 3), t6 = near.nodes.texel(1, 8, 0, 0), t4 = near.nodes.texel(1, 8, 3, 3);
  const FillCase c(mesh, {8, 8}, {t2, t6});
  for (const SurfaceFill& fill : {fill_exactly(c.problem()), fill_iteratively(c.problem())}) {
    CHECK(fill.source[t4] == t2);
    // Straight through the centre of an edge texel: from (3.5, 3.5) over (4.5, 3.5) to (4.5, 4.5).
    CHECK(static_cast<double>(fill.distance[t4]) * c.metric.step_length() == doctest::Approx(2.0).epsilon(1e-6));
  }
}

TEST_CASE("figures 6 to 8, stage by stage: alone, over the edge, further in") {
  Mesh mesh = mesh_of({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {8, 8, 0}}, {{0, 1, 2}, {3, 2, 1}});
  const FillCase near(mesh, {8, 8}, {0});
  const std::uint32_t t2 = near.nodes.texel(0, 8, 3, 3), t6 = near.nodes.texel(1, 8, 0, 0), t4 = near.nodes.texel(1, 8, 3, 3),
                      edge = near.nodes.texel(1, 8, 4, 3);
  const FillCase c(mesh, {8, 8}, {t2, t6});
  std::vector<SurfaceFill> seen;
  std::vector<FillStage> stages;
  const SurfaceFill end = fill_iteratively(c.problem(), [&](FillStage stage, const SurfaceFill& now) {
    stages.push_back(stage);
    seen.push_back(now);
  });
  REQUIRE(seen.size() == 2 * static_cast<std::size_t>(end.iterations));
  for (std::size_t n = 0; n < stages.size(); ++n) CHECK(stages[n] == (n % 2 == 0 ? FillStage::transformed : FillStage::propagated));
  CHECK(seen[0].source[edge] == t6);
  CHECK(seen[1].source[edge] == t2);
  CHECK(seen[1].source[t4] == t6);
  CHECK(seen[2].source[t4] == t2);
  CHECK(seen.back().source == end.source);
}

TEST_CASE("distances are whole steps rounded up, and obey the triangle inequality") {
  CHECK(grid_distance({0, 0, 0}, {3, 4, 0}) == 5);
  CHECK(grid_distance({0, 0, 0}, {1, 1, 0}) == 2);
  CHECK(grid_distance({7, 7, 7}, {7, 7, 7}) == 0);
  CHECK(grid_distance({0, 0, 0}, {1 << 30, 1 << 30, 1 << 30}) == 1859775394);  // √3·2^30 = 1859775393.4…
  CHECK(grid_distance({0, 0, 0}, {1 << 30, 1, 0}) == (1 << 30) + 1);
  Rng rng(6);
  const auto coordinate = [&] { return static_cast<std::int32_t>(rng.below((std::uint64_t{1} << rng.below(31)) + 1)); };
  for (int n = 0; n < 20000; ++n) {
    const GridPoint a{coordinate(), coordinate(), coordinate()}, b{coordinate(), coordinate(), coordinate()},
        c{coordinate(), coordinate(), coordinate()};
    REQUIRE(grid_distance(a, c) <= grid_distance(a, b) + grid_distance(b, c));
  }
}

TEST_CASE("centres are the corners' weighted places on the grid") {
  Rng rng(7);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const FillCase c = case_of(seed);
    for (std::uint32_t f = 0; f < c.mesh.face_count(); ++f) {
      const TexelPlane plane = c.metric.plane(f);
      const Tile& tile = c.atlas.tiles[f];
      const auto random_texel = [&] {
        const int i = static_cast<int>(rng.below(static_cast<std::uint64_t>(tile.size)));
        return std::array{i, static_cast<int>(rng.below(static_cast<std::uint64_t>(tile.size - i)))};
      };
      for (int n = 0; n < 40; ++n) {
        const auto [i, j] = random_texel();
        const Vec3d w = tile.center_weights(i, j);
        double x = 0;
        for (int k = 0; k < 3; ++k) x += w[k] * (static_cast<double>(c.mesh.position(FaceId(f), k).x) - bounding_box(c.mesh).lo.x);
        REQUIRE(std::abs(plane.center(i, j).x - x / c.metric.step_length()) < 0.501);
        REQUIRE(plane.center(i, j).x <= 1 << 30);
      }
    }
  }
}

TEST_CASE("the same for every thread count") {
  const FillCase c = case_of(7);
  const SurfaceFill exact = fill_exactly(c.problem()), iterative = fill_iteratively(c.problem());
  for (const int threads : {1, 2, 5}) {
    set_thread_count(threads);
    const SurfaceFill e = fill_exactly(c.problem()), i = fill_iteratively(c.problem());
    CHECK(e.source == exact.source);
    CHECK(i.source == iterative.source);
    CHECK(i.distance == iterative.distance);
    CHECK(i.iterations == iterative.iterations);
  }
  set_thread_count(0);
}
