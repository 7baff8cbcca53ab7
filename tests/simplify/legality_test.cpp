#include "core/simplify/legality.h"

#include <doctest/doctest.h>

#include "tests/simplify/sample_meshes.h"

using namespace etalon;
using namespace etalon::simplify;
using namespace etalon::test;

namespace {

Refusal judge(const Mesh& source, std::uint32_t u, std::uint32_t v, const LegalityOptions& options = {}) {
  const CollapseMesh mesh(source, {});
  const UnitPositions positions = unit_positions(mesh);
  Legality legality(mesh, positions, options);
  const CollapseMesh::Edge edge = mesh.find_edge(u, v);
  REQUIRE(edge.face_count() > 0);
  return legality.check(u, edge);
}

}  // namespace

TEST_CASE("a flat grid: inside, along the border, across it") {
  const Mesh grid = bumpy_grid(3, 0, 1);  // rows of 4
  CHECK(judge(grid, 5, 6) == Refusal::none);
  CHECK(judge(grid, 1, 2) == Refusal::none);
  CHECK(judge(grid, 5, 0) == Refusal::none);  // an inner vertex onto the border
}

TEST_CASE("link: an inner edge between two borders") {
  const Mesh strip = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  CHECK(judge(strip, 0, 2) == Refusal::link);
}

TEST_CASE("link: a third common neighbour") {
  // The torus of 3 × 3 squares: every two vertices of a row have the third one in common.
  CHECK(judge(torus(), 0, 1) == Refusal::link);
}

TEST_CASE("link: a hole between two fans of one vertex may not close") {
  // Two squares of two triangles that share vertex 0 and are joined at the far side of a triangular hole 0, 1, 2: vertex 0 has a fan with 1
  // and one with 2.
  const Mesh pinched = mesh_of({{0, 0, 0}, {1, 1, 0}, {1, -1, 0}, {0, 2, 0}, {0, -2, 0}, {3, 0, 0}},
                               {{0, 1, 3}, {0, 4, 2}, {1, 5, 3}, {4, 5, 2}, {1, 2, 5}});
  const CollapseMesh mesh(pinched, {});
  REQUIRE(mesh.repair().non_manifold_vertices.count == 1);
  // 1 into 0 along the hole: then 0-2 would be an edge of both fans.
  CHECK(judge(pinched, 1, 0) == Refusal::link);
  CHECK(judge(pinched, 2, 6) == Refusal::link);  // the second fan's vertex 0
}

TEST_CASE("the last faces: a tetrahedron, a triangle") {
  CHECK(judge(tetrahedron(), 0, 1) == Refusal::last_faces);
  const Mesh triangle = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  CHECK(judge(triangle, 0, 1) == Refusal::last_faces);
}

TEST_CASE("curve: a material's single triangle may not close") {
  Mesh grid = bumpy_grid(4, 0, 1);  // rows of 5
  grid.face_materials.assign(grid.face_count(), 0);
  grid.face_materials[10] = 1;  // square (1, 1), lower triangle: 6, 7, 12
  CHECK(judge(grid, 6, 7) == Refusal::curve);
}

TEST_CASE("space: a turned face, a face without area, the limit on the angle") {
  // A fan around 0 with a notch at 2, which hides 3 from 1: 0 → 1 turns the triangle 0, 2, 3.
  const Mesh notch =
      mesh_of({{0, 0, 0}, {3, 0, 0}, {0.5f, 0.5f, 0}, {-1, 2, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
  CHECK(judge(notch, 0, 1) == Refusal::flip_in_space);
  CHECK(judge(notch, 0, 4) == Refusal::none);
  // 0 → 1 makes 1, 2, 3 of no area.
  const Mesh flat = mesh_of({{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
  CHECK(judge(flat, 0, 1) == Refusal::flip_in_space);
  // A pyramid's tip onto its base: the faces that stay turn from steep to level. cos = 1 / sqrt(1 + 4) = 0.447.
  const Mesh pyramid = mesh_of({{0, 0, 2}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
  CHECK(judge(pyramid, 0, 1, {.min_normal_cosine = 0.4}) == Refusal::none);
  CHECK(judge(pyramid, 0, 1, {.min_normal_cosine = 0.45}) == Refusal::flip_in_space);
}

TEST_CASE("space: a face that has no area may go anywhere") {
  const Mesh needle = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 0}},
                              {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {5, 3, 4}, {0, 5, 4}, {0, 4, 1}});
  CHECK(judge(needle, 0, 5) == Refusal::none);
  CHECK(judge(needle, 5, 0) == Refusal::none);
}

TEST_CASE("texture: a flip in uv alone; a mirrored chart is judged by its own sign") {
  Mesh grid = bumpy_grid(3, 0, 1);  // rows of 4
  CHECK(judge(grid, 5, 6) == Refusal::none);
  grid.wedges[5].uv = {1.2f, 0.34f};          // moved behind its right neighbour in the texture: the faces around it fold
  CHECK(judge(grid, 5, 6) == Refusal::none);  // …and the collapse heals them
  CHECK(judge(grid, 5, 4) == Refusal::none);
  grid.wedges[5].uv = {1.0f / 3, 1.0f / 3};
  grid.wedges[6].uv = {0.34f, 0.9f};
  CHECK(judge(grid, 5, 6) == Refusal::flip_in_texture);
  Mesh mirrored = bumpy_grid(3, 0, 1);
  for (Wedge& w : mirrored.wedges) w.uv.x = 1 - w.uv.x;
  CHECK(judge(mirrored, 5, 6) == Refusal::none);
}

TEST_CASE("texture: a chart under one texel is judged in space only") {
  Mesh grid = bumpy_grid(3, 0, 1);
  grid.wedges[6].uv = {0.34f, 0.9f};
  for (Wedge& w : grid.wedges) w.uv = w.uv * 0x1p-11f;
  CHECK(judge(grid, 5, 6) == Refusal::none);
}

TEST_CASE("refusals have names") {
  for (std::size_t i = 0; i < kRefusalCount; ++i) CHECK(std::string(to_string(static_cast<Refusal>(i))) != "");
}
