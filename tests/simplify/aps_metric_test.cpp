#include "core/simplify/aps_metric.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/simplify/simplify.h"
#include "tests/simplify/sample_meshes.h"

using namespace etalon;
using namespace etalon::simplify;
using namespace etalon::test;

namespace {

/// The surface's point at a texture coordinate, by asking every face.
std::optional<Vec3d> point_at(const Mesh& mesh, const Vec2f& uv) {
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](int k) {
      const Vec2f& c = mesh.wedge(FaceId(f), k).uv;
      return Vec3d(c.x, c.y, 0);
    };
    const NearestOnTriangle found = nearest_on_triangle(Vec3d(uv.x, uv.y, 0), corner(0), corner(1), corner(2));
    if (found.distance2 > 0x1p-80) continue;
    const auto place = [&](int k) { return to_double(mesh.position(FaceId(f), k)); };
    return detail::at_weights({0, 0, 0}, place(0), place(1), place(2), found.weights).point;
  }
  return std::nullopt;
}

/// The largest distance found between the points of `count` texture coordinates, by chance and of the input's vertices.
double sampled_deviation(const Mesh& source, const Mesh& result, int count) {
  Rng rng(11);
  double largest = 0;
  int compared = 0;
  const auto compare = [&](const Vec2f& uv) {
    const auto a = point_at(source, uv), b = point_at(result, uv);
    if (!a || !b) return;
    ++compared;
    largest = std::max(largest, std::sqrt(squared_distance(*a, *b)));
  };
  for (int i = 0; i < count; ++i) compare({rng.uniform(0, 1), rng.uniform(0, 1)});
  for (const Wedge& w : source.wedges) compare(w.uv);
  CHECK(compared > count / 2);
  return largest;
}

}  // namespace

TEST_CASE("a peak into a corner: it moves by its height; nothing crosses") {
  // Corners of a square of side 2 at height 0, the middle at height 0.5; uv = (x, y). The longest side is 2, so lengths count half.
  const Mesh peak = mesh_of({{0, 0, 0.5f}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
  CollapseMesh mesh(peak, {});
  const UnitPositions positions = unit_positions(mesh);
  ApsMetric metric(mesh, positions, {});
  const CollapseMesh::Edge edge = mesh.find_edge(0, 1);
  const std::array ring{CollapseCandidate{1, edge.left}};
  metric.surround(0, ring);
  CHECK(metric.bound_of(0) == 0);
  CHECK(metric.cost_of(0) == 0.25);
  CHECK(metric.cost(0, 1, edge.left) == 0.25);
  metric.collapse(0, 1, edge);
  mesh.collapse(0, edge);
  int faces = 0;
  for (std::uint32_t f = 0; f < 4; ++f) {
    if (!mesh.face_alive(f)) continue;
    CHECK(metric.face_bound(f) == 0.25);
    ++faces;
  }
  CHECK(faces == 2);
}

TEST_CASE("a crossing: the deviation is largest where an old edge crosses a new one") {
  // A flat ring but for corner 3, at height 1: the middle lies on the new diagonal 1-3's side of nothing; the old edge 0-2 crosses 1-3's.
  const Mesh bent = mesh_of({{0.25f, 0.5f, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1}, {0, 0, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
  CollapseMesh mesh(bent, {});
  const UnitPositions positions = unit_positions(mesh);
  ApsMetric metric(mesh, positions, {});
  // Into 1 = (1, 0): the new diagonal runs from (1, 0) to (0, 1), x + y = 1. u = (0.25, 0.5) is in the face 1, 3, 4, whose height is y - 0
  // there:
  // z = y, so u is off by 0.5. The edge 0-2 crosses the diagonal where 0.25 + 0.75 t + 0.5 + 0.5 t = 1, t = 0.2, (0.4, 0.6): old height 0,
  // new 0.6.
  CHECK(metric.cost(0, 1, mesh.find_edge(0, 1).left) == doctest::Approx(0.6).epsilon(1e-12));
}

TEST_CASE("the bound holds: no point of the texture has moved farther than the error says") {
  for (const std::size_t target : {120u, 60u, 24u}) {
    CAPTURE(target);
    const Mesh grid = bumpy_grid(10, 0.3f, 2);
    const SimplifyResult result = simplify_mesh(grid, {.metric = MetricName::aps, .target_faces = target});
    const double deviation = sampled_deviation(grid, result.mesh, 2000);
    CHECK(deviation > 0);
    CHECK(deviation <= result.error * (1 + 1e-12));
    CHECK(result.error < 3);
  }
}

TEST_CASE("seams: both charts' bounds hold") {
  const Mesh grid = seamed_grid(10, 0.2f, 4);
  const SimplifyResult result = simplify_mesh(grid, {.metric = MetricName::aps, .target_faces = 60, .record_landings = true});
  CHECK(validate_mesh(result.mesh).chart_count == 2);
  CHECK(sampled_deviation(grid, result.mesh, 1000) <= result.error * (1 + 1e-12));
  CHECK(*result.distance_max > 0);
}

TEST_CASE("a flat grid with a texture that is stretched: positions alone do not say where the texture goes") {
  // u runs as x², piecewise linear: on a plane qem pays nothing, aps the shift of the texture.
  Mesh grid = bumpy_grid(8, 0, 1);
  for (Wedge& w : grid.wedges) w.uv.x = grid.positions[w.vertex.index].x * grid.positions[w.vertex.index].x;
  CHECK(simplify_mesh(grid, {.target_faces = 10}).error == 0);
  const SimplifyResult result = simplify_mesh(grid, {.metric = MetricName::aps, .target_faces = 10});
  CHECK(result.error > 0);
  CHECK(sampled_deviation(grid, result.mesh, 1000) <= result.error * (1 + 1e-12));
  CHECK(sampled_deviation(grid, result.mesh, 1000) < sampled_deviation(grid, simplify_mesh(grid, {.target_faces = 10}).mesh, 1000));
}
