#include "core/mesh/uv_overlap.h"

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "tests/mesh/tiny_meshes.h"

using namespace etalon;
using namespace etalon::test;

TEST_CASE("the square fills the grid exactly once") {
  for (const int grid : {1, 7, 64, 1000}) {
    const UvOverlap overlap = measure_uv_overlap(square(), grid, 5);
    CHECK(overlap.covered_cells == static_cast<std::size_t>(grid) * static_cast<std::size_t>(grid));
    CHECK(overlap.overlapped_cells == 0);
    CHECK(overlap.face_count == 0);
  }
}

TEST_CASE("a fan around any inner point fills the grid exactly once") {
  Rng rng(3);
  for (int i = 0; i < 200; ++i) {
    Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 0.5f, 0}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    mesh.wedges[4].uv = {rng.uniform(0.01f, 0.99f), rng.uniform(0.01f, 0.99f)};
    const UvOverlap overlap = measure_uv_overlap(mesh, 100, 5);
    REQUIRE(overlap.covered_cells == 10000);
    REQUIRE(overlap.overlapped_cells == 0);
  }
}

TEST_CASE("a half covered twice") {
  Mesh mesh = square();
  mesh.faces.push_back(mesh.faces[0]);
  const UvOverlap overlap = measure_uv_overlap(mesh, 100, 1);
  CHECK(overlap.overlapped_cells == 5050);  // 100·99/2 below the diagonal, and the 100 on it: it is a left edge of the lower triangle
  CHECK(overlap.share() == 0.505);
  CHECK(overlap.face_count == 2);
  CHECK(overlap.first_faces == std::vector<FaceId>{FaceId(0u)});
}

TEST_CASE("what lies outside is cut off, what is too far or not finite is left out") {
  Mesh mesh = square();
  for (Wedge& w : mesh.wedges) w.uv += Vec2f(0.5f, 0);
  CHECK(measure_uv_overlap(mesh, 10, 5).covered_cells == 50);
  mesh.wedges[0].uv.x = 2e9f;
  CHECK(measure_uv_overlap(mesh, 10, 5).covered_cells == 0);
  CHECK(UvOverlap{}.share() == 0);
  CHECK_THROWS_AS((void)measure_uv_overlap(mesh, 0, 5), InternalError);
}
