#include "core/simplify/kim_metric.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/simplify/simplify.h"
#include "tests/simplify/sample_meshes.h"

using namespace etalon;
using namespace etalon::simplify;
using namespace etalon::test;

namespace {

/// A flat fan: vertex 0 in the middle of a square of side 2, corners 1 to 4.
Mesh fan(const std::vector<Vec4f>& colors) {
  Mesh mesh = mesh_of({{0, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
  mesh.colors = colors;
  return mesh;
}

constexpr Vec4f kBlack{0, 0, 0, 1}, kRed{1, 0, 0, 1}, kWhite{1, 1, 1, 1};

double importance_of_middle(const Mesh& source) {
  const CollapseMesh mesh(source, {});
  const UnitPositions positions = unit_positions(mesh);
  return KimMetric(mesh, positions, {}, {}).importance(0);
}

}  // namespace

TEST_CASE("figure 3: a vertex unlike its neighbours is important, whatever the difference; one like them is not") {
  CHECK(importance_of_middle(fan({kRed, kBlack, kBlack, kBlack, kBlack})) == 4);
  CHECK(importance_of_middle(fan({kWhite, kBlack, kBlack, kBlack, kBlack})) == 4);
  CHECK(importance_of_middle(fan({kRed, kRed, kRed, kRed, kRed})) == 0);
  CHECK(importance_of_middle(fan({kRed, kBlack, kRed, kRed, kRed})) == 1);  // (1 + 0 + 0 + 0) / 1
}

TEST_CASE("equation 16 by hand: the middle of a square into a corner, figure 4") {
  const Mesh source = fan({kRed, kBlack, kRed, kBlack, kRed});
  const CollapseMesh mesh(source, {});
  const UnitPositions positions = unit_positions(mesh);
  const KimMetric metric(mesh, positions, {}, {.unit = 1});
  // Into corner 1, black. Corner 1: |1·√2 − 0|; corner 2, red: |0 − 1·2|; corner 3, black: |1·√2 − 0|; corner 4, red: |0 − 1·2|.
  CHECK(metric.color_error(0, 1) == doctest::Approx(2 * std::sqrt(2.0) + 4).epsilon(1e-15));
  // In units of half the length everything that is a length doubles.
  const KimMetric finer(mesh, positions, {}, {.unit = 0.5});
  CHECK(finer.color_error(0, 1) == doctest::Approx(4 * std::sqrt(2.0) + 8).epsilon(1e-15));
}

TEST_CASE("equation 17: the product; equation 15: importances add up") {
  const Mesh source = fan({kRed, kBlack, kRed, kBlack, kRed});
  const CollapseMesh mesh(source, {});
  const UnitPositions positions = unit_positions(mesh);
  KimMetric metric(mesh, positions, {.boundary_weight = 0}, {.unit = 1});
  // Flat, no boundary planes: Q = 0; I(0) = 2.
  CHECK(metric.cost(0, 1) == doctest::Approx(3 * (1 + 2 * std::sqrt(2.0) + 4)).epsilon(1e-15));
  const double before = metric.importance(1);
  metric.collapse(0, 1, mesh.find_edge(0, 1));
  CHECK(metric.importance(1) == before + 2);
}

TEST_CASE("the cost of a neighbour in hand has the bits of the cost, its bound is not above it") {
  Mesh sphere = bumpy_sphere(8, 0.3f, 5);
  for (const Vec3f& p : sphere.positions) sphere.colors.push_back({p.x * p.x, p.y * p.y, p.x > 0 ? 1.0f : 0.0f, 1});
  const CollapseMesh mesh(sphere, {});
  const UnitPositions positions = unit_positions(mesh);
  KimMetric metric(mesh, positions, {}, {});
  int above = 0;
  for (std::uint32_t u = 0; u < mesh.vertex_capacity(); ++u) {
    std::vector<CollapseCandidate> ring;
    mesh.for_each_neighbor(u, [&](std::uint32_t v, std::uint32_t h) { ring.push_back({v, h}); });
    metric.surround(u, ring);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      CHECK(metric.cost_of(i) == metric.cost(u, ring[i].target));
      CHECK(metric.bound_of(i) <= metric.cost_of(i));
      above += metric.cost_of(i) > metric.bound_of(i) ? 1 : 0;
    }
  }
  CHECK(above > 0);
}

TEST_CASE("a unit beside which the model is infinite is refused") {
  const Mesh source = fan({kRed, kBlack, kRed, kBlack, kRed});
  CHECK_THROWS_WITH_AS(simplify_mesh(source, {.metric = MetricName::kim, .target_faces = 2, .kim = {.unit = 1e-100}}),
                       "metric kim: unit: expected a length beside which the model's fourth power is a finite number, got 1e-100",
                       InputError);
}

TEST_CASE("the state is 48 bytes a vertex, and a model without colour differences is simplified as by its quadrics") {
  Mesh sphere = bumpy_sphere(6, 0.3f, 5);
  sphere.colors.assign(sphere.vertex_count(), kRed);
  // Units so small that 1 + Q keeps the order of Q.
  const SimplifyResult kim = simplify_mesh(sphere, {.metric = MetricName::kim, .target_faces = 80, .kim = {.unit = 1e-8}});
  CHECK(kim.mesh == simplify_mesh(sphere, {.target_faces = 80}).mesh);
  CHECK(kim.state_bytes_per_vertex == 48);
}

TEST_CASE("colours matter: an edge of colours is kept where a quadric sees nothing") {
  Mesh grid = bumpy_grid(10, 0, 1);
  for (const Vec3f& p : grid.positions) grid.colors.push_back(p.x < 0.5f ? kBlack : kWhite);
  const SimplifyResult result = simplify_mesh(grid, {.metric = MetricName::kim, .target_faces = 20});
  for (std::size_t f = 0; f < result.mesh.face_count(); ++f) {
    // No face blends the colours over more than the one column of squares that did before.
    bool black = false, white = false;
    float low = 1, high = 0;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = result.mesh.vertex(FaceId(f), k).index;
      (result.mesh.colors[v].x > 0 ? white : black) = true;
      low = std::min(low, result.mesh.positions[v].x);
      high = std::max(high, result.mesh.positions[v].x);
    }
    if (black && white) CHECK(high - low < 0.11f);
  }
}
