#include "core/simplify/quadric.h"

#include <doctest/doctest.h>

#include "core/base/rng.h"
#include "core/simplify/qem_metric.h"
#include "tests/simplify/sample_meshes.h"

using namespace etalon;
using namespace etalon::simplify;
using namespace etalon::test;

TEST_CASE("one plane: the squared distance, from wherever it is measured") {
  Quadric3<double> q;
  add_plane_at_origin(q, {0.6, 0, 0.8}, 2);
  // Distance of (1, 5, 2) to the plane through 0: 0.6 + 1.6 = 2.2; weight 2.
  CHECK(evaluate(q, Vec3d(1, 5, 2)) == doctest::Approx(9.68).epsilon(1e-15));
  CHECK(evaluate(q, Vec3d(0.8, 3, -0.6)) == doctest::Approx(0).epsilon(1e-15));
  const Quadric3<double> from = moved(q, Vec3d(1, 5, 2));
  CHECK(from.c == evaluate(q, Vec3d(1, 5, 2)));
  CHECK(evaluate(from, Vec3d(-1, -5, -2)) == doctest::Approx(0).epsilon(1e-14));
  CHECK(total_weight(q) == doctest::Approx(2).epsilon(1e-15));
}

TEST_CASE("integers: sums and moves are exact") {
  Quadric3<double> q;
  add_plane_at_origin(q, {1, 0, 0}, 1);
  add_plane_at_origin(q, {0, 1, 0}, 3);
  const Quadric3<double> both = sum(moved(q, Vec3d(2, 1, 0)), q);
  // From the new origin: (x + 2)² + 3(y + 1)² + x² + 3y² at (1, 1, 7): 9 + 12 + 1 + 3.
  CHECK(evaluate(both, Vec3d(1, 1, 7)) == 25);
  const Quadric3<float> stored = rounded(both);
  CHECK(evaluate(stored, Vec3d(1, 1, 7)) == 25);
}

TEST_CASE("the vertices of a cube: three planes, no error where they are; the cost of an edge is the area of what it leaves") {
  // A box corner: three unit right triangles that meet in the origin.
  const Mesh corner = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}});
  const CollapseMesh mesh(corner, {});
  const UnitPositions positions = unit_positions(mesh);
  CHECK(positions.unit == 1);
  const QemMetric metric(mesh, positions, {.boundary_weight = 0, .seam_weight = 0});
  // The origin's planes x = 0, y = 0, z = 0 with area ½ each; vertex 1 is off the first by 1.
  CHECK(metric.cost(0, 1) == 0.5);
  CHECK(metric.squared_distance(0, 1, 0.5) == 0.5 / 2.5);  // weights 1.5 and 1
  // Vertex 1 is on y = 0 and z = 0, as the origin is.
  CHECK(metric.cost(1, 0) == 0);
}

TEST_CASE("costs after collapses are those of the planes gathered, within the rounding of the state") {
  const Mesh sphere = bumpy_sphere(5, 0.2f, 9);
  CollapseMesh mesh(sphere, {});
  const UnitPositions positions = unit_positions(mesh);
  QemMetric metric(mesh, positions, {});
  // 0 into a neighbour, that one into a third: the cost of the second step is about the quadrics summed in double.
  const std::uint32_t a = 0, b = mesh.end(mesh.first_out(a));
  const double direct = metric.cost(a, b);
  metric.collapse(a, b, mesh.find_edge(a, b));
  std::uint32_t c = kNone;
  mesh.for_each_neighbor(b, [&](std::uint32_t n, std::uint32_t) {
    if (n != a && c == kNone) c = n;
  });
  // The state of b now holds `direct` as its constant: a zero-length move costs it, rounded to float32 (2^-24 relative).
  CHECK(metric.cost(b, b) == doctest::Approx(2 * direct).epsilon(0x1p-23));
  CHECK(metric.cost(b, c) > 0);
}

TEST_CASE("boundary planes: a corner of a flat square costs, a point on its straight edge does not") {
  const Mesh grid = bumpy_grid(2, 0, 1);  // 3 × 3 vertices on a plane
  const CollapseMesh mesh(grid, {});
  const UnitPositions positions = unit_positions(mesh);
  const QemMetric metric(mesh, positions, {});
  CHECK(metric.cost(1, 0) == 0);  // along the straight edge
  CHECK(metric.cost(0, 1) > 0);   // the corner leaves its two borders
  const QemMetric without(mesh, positions, {.boundary_weight = 0});
  CHECK(without.cost(0, 1) == 0);
}

TEST_CASE("unit positions: a power of two, rounding nothing") {
  Mesh tall = tetrahedron();
  for (Vec3f& p : tall.positions) p = p * 3.7f + Vec3f(100, -7, 0.125f);
  const CollapseMesh mesh(tall, {});
  const UnitPositions positions = unit_positions(mesh);
  CHECK(positions.unit == 4);
  for (std::uint32_t v = 0; v < 4; ++v) CHECK(positions.at[v] * 4.0f == tall.positions[v]);
  Mesh tiny = tetrahedron();
  for (Vec3f& p : tiny.positions) p = p * 0x1p-100f;
  const CollapseMesh small(tiny, {});
  CHECK(unit_positions(small).unit == 0x1p-100);
  Mesh point = tetrahedron();
  for (Vec3f& p : point.positions) p = {5, 5, 5};
  const CollapseMesh nothing(point, {});
  CHECK(unit_positions(nothing).unit == 1);
}
