#include "core/adapt/ring_cells.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/mesh/exact_orientation.h"
#include "tests/adapt/ring_fixture.h"

using namespace etalon;
using namespace etalon::adapt;

namespace {

double doubled_area_before(const CollapseRing& ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.triangles_before(); ++k) sum += doubled_area(ring.uv_of_u, ring.uv[k], ring.uv[(k + 1) % ring.size()]);
  return sum;
}

double doubled_area_after(const CollapseRing& ring) {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) sum += doubled_area(ring.uv[0], ring.uv[k], ring.uv[k + 1]);
  return sum;
}

// A square around u, v at its lower left; all in the plane of the texture.
CollapseRing square(const Vec2f& uv_of_u, const Vec3f& position_of_u) {
  CollapseRing ring;
  ring.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const Vec2f& uv : ring.uv) ring.positions.push_back({uv.x, uv.y, 0});
  ring.uv_of_u = uv_of_u, ring.position_of_u = position_of_u;
  return ring;
}

}  // namespace

TEST_CASE("cells: u in a triangle of the square; one spoke crosses the diagonal") {
  // Corner 3 (upper left) is across the diagonal 0–2 from u: one crossing, and six cells.
  const auto cells = make_ring_cells(square({0.75f, 0.5f}, {0.75f, 0.5f, 0}));
  REQUIRE(cells);
  CHECK(cells->cells.size() == 6);
  REQUIRE(cells->nodes.size() == 6);
  CHECK(cells->nodes[0] == CellNode{{0.75f, 0.5f}, {0.75f, 0.5f}});
  // The spoke (¾, ½)–(0, 1) meets y = x at 3/5.
  CHECK(cells->nodes[5].before.x == 0.6f);
  CHECK(cells->nodes[5].after.y == 0.6f);
  CHECK(cells->u_kept == 1);
  CHECK(cells->crossings_kept == 1);
}

TEST_CASE("cells: u on the diagonal makes no empty cells") {
  const auto cells = make_ring_cells(square({0.5f, 0.5f}, {0.25f, 0.25f, 0}));
  REQUIRE(cells);
  CHECK(cells->cells.size() == 4);
  CHECK(cells->nodes.size() == 5);
  CHECK(cells->nodes[0].after == Vec2f{0.25f, 0.25f});  // where the surface has it
}

TEST_CASE("cells: a place that does not see the ring is damped") {
  CollapseRing ring = square({0.25f, 0.25f}, {0.95f, 0.05f, 0});
  ring.uv[2] = {0.4f, 0.4f};  // a notch: near the lower right corner its other side is out of sight
  const auto cells = make_ring_cells(ring);
  REQUIRE(cells);
  CHECK(cells->u_kept < 1);
}

TEST_CASE("cells: on a curve u slides along the new edge") {
  // Figure 1 of the paper with a strip behind it: C is at 0.3 of the texture and half way of the surface.
  CollapseRing ring;
  ring.on_curve = true;
  ring.uv = {{1, 0}, {1, 1}, {0, 1}, {0, 0}};
  ring.uv_of_u = {0.3f, 0};
  ring.positions = {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
  ring.position_of_u = {0.5f, 0, 0.5f};
  const auto cells = make_ring_cells(ring);
  REQUIRE(cells);
  CHECK(cells->nodes[0].after == Vec2f{0.5f, 0});
  CHECK(cells->nodes[0].before == Vec2f{0.3f, 0});
  CHECK(cells->cells.size() == 5);
}

TEST_CASE("cells: positive before and after, and nothing left over, for random rings") {
  Rng rng(7);
  int all_kept = 0, none = 0, rings = 0;
  for (const bool on_curve : {false, true})
    for (int n = 0; n < 4000; ++n, ++rings) {
      const CollapseRing ring = test::random_ring(rng, on_curve ? 3 + n % 4 : 3 + n % 8, false, on_curve);
      const auto cells = make_ring_cells(ring);
      if (!cells) {
        ++none;
        continue;
      }
      all_kept += cells->u_kept == 1 && cells->crossings_kept == 1 ? 1 : 0;
      double before = 0, after = 0;
      for (const auto& cell : cells->cells) {
        const CellNode &a = cells->nodes[cell[0]], &b = cells->nodes[cell[1]], &c = cells->nodes[cell[2]];
        REQUIRE(orientation(a.before, b.before, c.before) > 0);
        REQUIRE(orientation(a.after, b.after, c.after) > 0);
        before += doubled_area(a.before, b.before, c.before), after += doubled_area(a.after, b.after, c.after);
      }
      // A node is off its spoke or diagonal by half a last place of coordinates below 1, 2^-25 in each axis, and edges are below √2: each
      // cell's doubled area is off by less than 3·2^-24. On a curve u itself is off the new edge, by as much.
      const double rounding = static_cast<double>(cells->cells.size()) * 0x1p-22;
      REQUIRE(std::abs(before - doubled_area_before(ring)) < rounding);
      REQUIRE(std::abs(after - doubled_area_after(ring)) < rounding);
    }
  CHECK(all_kept > rings / 4);
  CHECK(none < rings / 10);  // curves whose nearest point is an end of the new edge
}

TEST_CASE("cells: what is refused") {
  CollapseRing ring = square({0.5f, 0.5f}, {0.5f, 0.5f, 0});
  ring.uv_of_u = {2, 2};
  CHECK_THROWS_AS((void)make_ring_cells(ring), InputError);
  ring.uv.resize(2), ring.positions.resize(2);
  CHECK_THROWS_AS((void)make_ring_cells(ring), InputError);
  ring.on_curve = true;
  CHECK_FALSE(make_ring_cells(ring));
}
