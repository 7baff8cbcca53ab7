#include "core/adapt/cell_map.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/math/nearest_point.h"
#include "core/mesh/exact_orientation.h"
#include "tests/adapt/ring_fixture.h"

using namespace etalon;
using namespace etalon::adapt;

namespace {

std::vector<test::TexturedCorners> triangles_before(const CollapseRing& ring) {
  std::vector<test::TexturedCorners> result;
  for (std::size_t k = 0; k < ring.triangles_before(); ++k) {
    const std::size_t l = (k + 1) % ring.size();
    result.push_back({{ring.uv_of_u, ring.uv[k], ring.uv[l]}, {ring.position_of_u, ring.positions[k], ring.positions[l]}});
  }
  return result;
}

std::vector<test::TexturedCorners> triangles_after(const CollapseRing& ring) {
  std::vector<test::TexturedCorners> result;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k)
    result.push_back({{ring.uv[0], ring.uv[k], ring.uv[k + 1]}, {ring.positions[0], ring.positions[k], ring.positions[k + 1]}});
  return result;
}

}  // namespace

TEST_CASE("cell map: on a plane the adapted texture shows every point what it showed before (the paper's Figure 3)") {
  Rng rng(11);
  int exact_rings = 0;
  for (int n = 0; n < 4000; ++n) {
    const CollapseRing ring = test::random_ring(rng, 3 + n % 6, true, false);
    const auto cells = make_ring_cells(ring);
    REQUIRE(cells);
    if (cells->u_kept < 1 || cells->crossings_kept < 1) continue;
    ++exact_rings;
    for (int i = 0; i < 8; ++i) {
      const Vec2d after = test::random_point_of(rng, triangles_after(ring));
      const auto before = map_point(*cells, AdaptDirection::to_before, after);
      REQUIRE(before);
      const test::TexturedPoint shown = test::textured_point(triangles_after(ring), after),
                                was = test::textured_point(triangles_before(ring), *before);
      // Nodes are rounded to float32 below 1, by 2^-24 along either axis in either texture; what lies between them by no more.
      const double allowed = 4 * 0x1p-24 * (shown.stretch + was.stretch);
      CHECK(std::sqrt(squared_distance(shown.point, was.point)) <= allowed);
    }
  }
  CHECK(exact_rings > 1000);
}

TEST_CASE("cell map: without adaptation the plane shows something else") {
  Rng rng(11);
  int different = 0;
  for (int n = 0; n < 100; ++n) {
    const CollapseRing ring = test::random_ring(rng, 6, true, false);
    const Vec2d p = test::random_point_of(rng, triangles_after(ring));
    const test::TexturedPoint shown = test::textured_point(triangles_after(ring), p), was = test::textured_point(triangles_before(ring), p);
    different += std::sqrt(squared_distance(shown.point, was.point)) > 0.01 ? 1 : 0;
  }
  CHECK(different > 50);
}

TEST_CASE("cell map: down and up again") {
  Rng rng(12);
  int points = 0;
  for (int n = 0; n < 2000; ++n) {
    const bool on_curve = n % 2 == 1;
    const CollapseRing ring = test::random_ring(rng, on_curve ? 4 : 6, false, on_curve);
    const auto cells = make_ring_cells(ring);
    if (!cells) continue;
    double thinnest = 1;  // of all cells: doubled area over the square of a length that none exceeds
    for (const auto& cell : cells->cells) {
      const CellNode &a = cells->nodes[cell[0]], &b = cells->nodes[cell[1]], &c = cells->nodes[cell[2]];
      thinnest = std::min({thinnest, doubled_area(a.before, b.before, c.before), doubled_area(a.after, b.after, c.after)});
    }
    for (int i = 0; i < 8; ++i) {
      const Vec2d p = test::random_point_of(rng, triangles_after(ring));
      const auto before = map_point(*cells, AdaptDirection::to_before, p);
      REQUIRE(before);
      const auto back = map_point(*cells, AdaptDirection::to_after, *before);
      REQUIRE(back);
      ++points;
      // Some twenty roundings of numbers below 2, divided by the area once and spread by the other cell's shape.
      CHECK(std::abs(back->x - p.x) + std::abs(back->y - p.y) <= 0x1p-46 / thinnest);
      if (thinnest > 0x1p-15) CHECK(std::abs(back->x - p.x) + std::abs(back->y - p.y) <= 0x1p-30);
    }
  }
  CHECK(points > 10'000);
}

TEST_CASE("cell map: outside there is nothing") {
  Rng rng(13);
  const auto cells = make_ring_cells(test::random_ring(rng, 5, true, false));
  REQUIRE(cells);
  CHECK_FALSE(map_point(*cells, AdaptDirection::to_before, {3, 3}));
  CHECK_FALSE(map_point(*cells, AdaptDirection::to_after, {-1, 0.5}));
}
