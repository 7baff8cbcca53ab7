#include "core/mesh/landing.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mesh/charts.h"
#include "core/simplify/landing_tracker.h"
#include "core/simplify/simplify.h"
#include "tests/simplify/sample_meshes.h"

using namespace etalon;
using namespace etalon::simplify;
using namespace etalon::test;

TEST_CASE("every vertex lands: in a face that is there, with weights that are a point of it, no nearer than the surface is") {
  for (const NamedMesh& sample : sample_meshes()) {
    for (const std::size_t percent : {80u, 40u, 10u, 0u, 180u, 140u, 110u, 100u}) {
      CAPTURE(sample.name);
      CAPTURE(percent);
      const Mesh& source = sample.mesh;
      const bool full = percent >= 100;
      const SimplifyResult result = simplify_mesh(source, {.collapse = full ? CollapseKind::full : CollapseKind::half,
                                                           .target_faces = source.face_count() * (percent % 100) / 100,
                                                           .record_landings = true});
      REQUIRE(result.landings.size() == source.vertex_count());
      REQUIRE(result.distance_max.has_value());
      for (std::uint32_t v = 0; v < source.vertex_count(); ++v) {
        const Landing& landing = result.landings[v];
        REQUIRE(landing.face.index < result.mesh.face_count());
        REQUIRE(std::min({landing.weights.x, landing.weights.y, landing.weights.z}) >= -0x1p-50);
        REQUIRE(std::max({landing.weights.x, landing.weights.y, landing.weights.z}) <= 1);
        const Vec3d p = to_double(source.positions[v]);
        double nearest = std::numeric_limits<double>::infinity();
        for (std::uint32_t f = 0; f < result.mesh.face_count(); ++f) {
          const auto at = [&](int k) { return to_double(result.mesh.position(FaceId(f), k)); };
          nearest = std::min(nearest, nearest_on_triangle(p, at(0), at(1), at(2)).distance2);
        }
        const double landed = std::sqrt(squared_distance(p, landing_point(result.mesh, landing)));
        REQUIRE(landed >= std::sqrt(nearest) - 0x1p-45);  // both roundings are of coordinates below 4
        REQUIRE(landed <= *result.distance_max);
      }
      for (std::uint32_t v = 0; v < result.mesh.vertex_count(); ++v) {
        const Landing& landing = result.landings[result.source_vertex[v].index];
        if (result.mesh.positions[v] != source.positions[result.source_vertex[v].index]) continue;  // it has moved
        if (full) continue;                                                                         // it may have moved and come back
        const int corner = landing.weights.x == 1 ? 0 : landing.weights.y == 1 ? 1 : 2;
        REQUIRE(landing.weights[corner] == 1);
        REQUIRE(result.mesh.vertex(landing.face, corner) == VertexId(v));
      }
    }
  }
}

TEST_CASE("a flat grid: every vertex lands on its own place") {
  const Mesh grid = bumpy_grid(8, 0, 1);
  const SimplifyResult result = simplify_mesh(grid, {.target_faces = 2, .record_landings = true});
  CHECK(*result.distance_max < 0x1p-50);
}

TEST_CASE("a vertex stays in its chart, and on its curve") {
  const Mesh grid = seamed_grid(8, 0.2f, 4);
  const SimplifyResult result = simplify_mesh(grid, {.target_faces = 24, .record_landings = true});
  const Charts charts = find_charts(result.mesh);
  REQUIRE(charts.charts.size() == 2);
  int on_seam = 0;
  for (std::uint32_t v = 0; v < grid.vertex_count(); ++v) {
    const Landing& landing = result.landings[v];
    const float x = grid.positions[v].x;
    const bool right = charts.charts[charts.of_face[landing.face.index]].sign < 0;
    if (x < 0.5f) CHECK_FALSE(right);
    if (x > 0.5f) CHECK(right);
    const Vec3d at = landing_point(result.mesh, landing);
    if (x == 0.5f) {
      on_seam += landing.on_curve ? 1 : 0;
      CHECK(at.x == 0.5);  // the seam lies in the plane x = 0.5
    }
    if (x == 0) CHECK(at.x == 0);
    if (grid.positions[v].y == 1) CHECK(at.y == 1);
  }
  CHECK(on_seam > 0);
}

TEST_CASE("landings are not recorded unless asked for; the mesh is the same") {
  const Mesh sphere = bumpy_sphere(6, 0.2f, 3);
  const SimplifyResult without = simplify_mesh(sphere, {.target_faces = 60});
  const SimplifyResult with = simplify_mesh(sphere, {.target_faces = 60, .record_landings = true});
  CHECK(without.landings.empty());
  CHECK_FALSE(without.distance_max.has_value());
  CHECK(with.mesh == without.mesh);
}

TEST_CASE("a vertex of no face lands nowhere") {
  Mesh mesh = square();
  mesh.positions.push_back({9, 9, 9});
  CHECK_FALSE(simplify_mesh(mesh, {.target_faces = 2, .record_landings = true}).landings[4].face.valid());
}
