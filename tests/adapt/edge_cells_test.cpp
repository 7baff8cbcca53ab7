// Cells of full-edge collapses: a partition of the ring in both textures, exact on a plane, the identity where all is damped.
#include "core/adapt/edge_cells.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/adapt/cell_map.h"
#include "core/base/error.h"
#include "core/math/nearest_point.h"
#include "core/mesh/exact_orientation.h"
#include "tests/adapt/ring_fixture.h"

using namespace etalon;
using namespace etalon::adapt;

namespace {

std::vector<test::TexturedCorners> surface_before(const EdgeRing& ring) {
  const auto uv = [&](std::uint16_t n) { return n == kNodeU ? ring.uv_of_u : n == kNodeV ? ring.uv_of_v : ring.uv[n - kFirstRingNode]; };
  const auto at = [&](std::uint16_t n) {
    return n == kNodeU ? ring.position_of_u : n == kNodeV ? ring.position_of_v : ring.positions[n - kFirstRingNode];
  };
  std::vector<test::TexturedCorners> result;
  for (const auto& [a, b, c] : triangles_before(ring)) result.push_back({{uv(a), uv(b), uv(c)}, {at(a), at(b), at(c)}});
  return result;
}

std::vector<test::TexturedCorners> surface_after(const EdgeRing& ring) {
  std::vector<test::TexturedCorners> result;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const std::size_t l = (k + 1) % ring.size();
    result.push_back({{ring.uv_of_w, ring.uv[k], ring.uv[l]}, {ring.position_of_w, ring.positions[k], ring.positions[l]}});
  }
  return result;
}

double doubled_area_of(const std::vector<test::TexturedCorners>& surface) {
  double sum = 0;
  for (const test::TexturedCorners& c : surface) sum += doubled_area(c.uv[0], c.uv[1], c.uv[2]);
  return sum;
}

void require_partition(const EdgeRing& ring, const RingCells& cells) {
  double before = 0, after = 0;
  for (const auto& cell : cells.cells) {
    const CellNode &a = cells.nodes[cell[0]], &b = cells.nodes[cell[1]], &c = cells.nodes[cell[2]];
    REQUIRE(orientation(a.before, b.before, c.before) > 0);
    REQUIRE(orientation(a.after, b.after, c.after) > 0);
    before += doubled_area(a.before, b.before, c.before), after += doubled_area(a.after, b.after, c.after);
  }
  // As of half-edge cells: every cell's doubled area is off by less than 3·2^-24, from the rounding of its corners.
  const double rounding = static_cast<double>(cells.cells.size()) * 0x1p-22;
  REQUIRE(std::abs(before - doubled_area_of(surface_before(ring))) < rounding);
  REQUIRE(std::abs(after - doubled_area_of(surface_after(ring))) < rounding);
  // A planar map of N nodes, n of them on the border, has 2N − n − 2 triangles: nothing is left out or there twice.
  REQUIRE(cells.cells.size() == 2 * cells.nodes.size() - ring.size() - 2);
}

// u and v on a horizontal, four corners around.
EdgeRing diamond(const Vec2f& uv_of_w) {
  EdgeRing ring;
  ring.uv = {{0.5f, 1}, {0, 0.5f}, {0.5f, 0}, {1, 0.5f}};  // a, left, b, right: u is on the left, its fan a to b
  ring.last_of_u = 2;
  ring.uv_of_u = {0.375f, 0.5f}, ring.uv_of_v = {0.625f, 0.5f}, ring.uv_of_w = uv_of_w;
  const auto lift = [](const Vec2f& p) { return Vec3f{p.x, p.y, 0}; };
  for (const Vec2f& p : ring.uv) ring.positions.push_back(lift(p));
  ring.position_of_u = lift(ring.uv_of_u), ring.position_of_v = lift(ring.uv_of_v), ring.position_of_w = lift(uv_of_w);
  return ring;
}

}  // namespace

TEST_CASE("edge cells: u, v and w in a diamond, by hand") {
  // u → v with a above is seen from u on the left: left of u→v is the upper side. Corner 0 is a.
  const EdgeRing ring = diamond({0.5f, 0.625f});
  REQUIRE(is_unfolded(ring));
  const auto cells = make_edge_cells(ring);
  REQUIRE(cells);
  CHECK(cells->plane == OverlayPlane::edge_space);
  // w is above the edge: w–b crosses it in the middle, w–left crosses u–a, w–right v–a.
  REQUIRE(cells->nodes.size() == 3 + 4 + 3);
  CHECK(cells->nodes[kNodeU] == CellNode{{0.375f, 0.5f}, {0.375f, 0.5f}});
  CHECK(cells->nodes[kNodeW] == CellNode{{0.5f, 0.625f}, {0.5f, 0.625f}});
  CHECK(std::any_of(cells->nodes.begin() + 7, cells->nodes.end(), [](const CellNode& node) {
    return node == CellNode{{0.5f, 0.5f}, {0.5f, 0.5f}};
  }));
  require_partition(ring, *cells);
  for (const CellNode& node : cells->nodes) {  // a flat piece that is its own texture: nothing moves
    CHECK(std::abs(node.before.x - node.after.x) <= 0x1p-24);
    CHECK(std::abs(node.before.y - node.after.y) <= 0x1p-24);
  }
}

TEST_CASE("edge cells: w on the edge is degenerate and refused") { CHECK_FALSE(make_edge_cells(diamond({0.5f, 0.5f}))); }

TEST_CASE("edge cells: positive in both textures, and nothing left over, for random rings") {
  Rng rng(31);
  int made = 0, all_kept = 0, in_space = 0, damped = 0;
  for (int n = 0; n < 4000; ++n) {
    const EdgeRing ring = test::random_edge_ring(rng, 4 + n % 7, false);
    const auto cells = make_edge_cells(ring);
    if (!cells) continue;
    ++made;
    all_kept += cells->u_kept == 1 && cells->crossings_kept == 1 ? 1 : 0;
    damped += cells->u_kept == 0 ? 1 : 0;
    in_space += cells->plane == OverlayPlane::edge_space ? 1 : 0;
    require_partition(ring, *cells);
    const auto again = edge_cells_at(ring, {cells->plane, cells->u_kept, cells->crossings_kept});
    REQUIRE(again);
    REQUIRE(*again == *cells);
  }
  MESSAGE(made << " of 4000 have cells, " << all_kept << " undamped, " << in_space << " laid over in space, " << damped
               << " with u and v where they were");
  CHECK(made > 3990);     // rounding alone refuses: with both shares 0 cells are positive by construction
  CHECK(all_kept > 100);  // space and texture have nothing in common here
}

TEST_CASE("edge cells: with both shares 0 the map is the identity") {
  Rng rng(32);
  int rings = 0;
  for (int n = 0; n < 1000; ++n) {
    const EdgeRing ring = test::random_edge_ring(rng, 4 + n % 7, n % 2 == 0);
    const auto cells = edge_cells_at(ring, {OverlayPlane::edge_texture_after, 0, 0});
    if (!cells) continue;
    ++rings;
    require_partition(ring, *cells);
    // w's place and the crossings are computed along other edges before and after: each within a few roundings of double of the point that
    // both mean, then rounded to float32.
    for (const CellNode& node : cells->nodes) {
      REQUIRE(std::abs(node.before.x - node.after.x) <= 0x1p-22);
      REQUIRE(std::abs(node.before.y - node.after.y) <= 0x1p-22);
    }
  }
  CHECK(rings > 990);
}

TEST_CASE("edge cells: on a plane the adapted texture shows every point what it showed before") {
  Rng rng(33);
  int exact_rings = 0;
  for (int n = 0; n < 2000; ++n) {
    const EdgeRing ring = test::random_edge_ring(rng, 4 + n % 6, true);
    const auto cells = make_edge_cells(ring);
    REQUIRE(cells);
    if (cells->u_kept < 1 || cells->crossings_kept < 1 || cells->plane != OverlayPlane::edge_space) continue;
    ++exact_rings;
    const std::vector<test::TexturedCorners> before = surface_before(ring), after = surface_after(ring);
    for (int i = 0; i < 8; ++i) {
      const Vec2d p = test::random_point_of(rng, after);
      const auto q = map_point(*cells, AdaptDirection::to_before, p);
      REQUIRE(q);
      const test::TexturedPoint shown = test::textured_point(after, p), was = test::textured_point(before, *q);
      // Nodes are rounded to float32 below 1, by 2^-24 along either axis in either texture; what lies between them by no more.
      CHECK(std::sqrt(squared_distance(shown.point, was.point)) <= 4 * 0x1p-24 * (shown.stretch + was.stretch));
    }
  }
  MESSAGE(exact_rings << " of 2000 planar rings kept all of the nearest points");
  CHECK(exact_rings > 1500);
}

TEST_CASE("edge cells: what is refused") {
  EdgeRing ring = diamond({0.5f, 0.625f});
  ring.uv_of_w = {2, 2};
  CHECK_THROWS_AS((void)make_edge_cells(ring), InputError);
  ring = diamond({0.5f, 0.625f});
  ring.last_of_u = 4;
  CHECK_THROWS_AS((void)make_edge_cells(ring), InputError);
  ring = diamond({0.5f, 0.625f});
  ring.positions.pop_back();
  CHECK_THROWS_AS((void)make_edge_cells(ring), InputError);
  CHECK_THROWS_AS((void)edge_cells_at(diamond({0.5f, 0.625f}), {OverlayPlane::texture_after, 1, 1}), InternalError);
}
