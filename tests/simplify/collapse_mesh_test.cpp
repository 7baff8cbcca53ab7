#include "core/simplify/collapse_mesh.h"

#include <doctest/doctest.h>

#include "tests/simplify/sample_meshes.h"

using namespace etalon;
using namespace etalon::simplify;
using namespace etalon::test;

TEST_CASE("every sample mesh becomes half-edges whose invariants hold") {
  for (const NamedMesh& sample : sample_meshes()) {
    CAPTURE(sample.name);
    const CollapseMesh mesh(sample.mesh, {});
    CHECK(mesh.violation() == "");
    CHECK(mesh.face_count() == sample.mesh.face_count());
    CHECK_FALSE(mesh.repair().non_manifold());
  }
}

TEST_CASE("kinds: inside, along a curve, and where curves meet or end") {
  const Mesh grid = seamed_grid(4, 0.1f, 1);  // vertices in rows of 5; the seam is column 2
  const CollapseMesh mesh(grid, {VertexId(6u)});
  CHECK(mesh.kind(8) == VertexKind::interior);
  CHECK(mesh.kind(6) == VertexKind::locked);  // by the caller
  CHECK(mesh.kind(1) == VertexKind::curve);   // boundary
  CHECK(mesh.kind(0) == VertexKind::curve);   // a corner of the square is on its boundary as any other
  CHECK(mesh.kind(12) == VertexKind::curve);  // seam
  CHECK(mesh.kind(2) == VertexKind::locked);  // where the seam meets the boundary
  CHECK(mesh.kind(22) == VertexKind::locked);
}

TEST_CASE("a seam that ends inside has a locked tip") {
  Mesh grid = bumpy_grid(4, 0, 1);
  // Faces left of column 2 in row 0 and 1 get other texture coordinates at (2, 0) and (2, 1): the cut ends at (2, 2) or before it.
  for (std::uint32_t f : {2u, 10u}) {  // the squares (1, 0) and (1, 1): triangles a b c
    set_corner_uv(grid, f, 1, {5, 5});
  }
  const CollapseMesh mesh(grid, {});
  CHECK(mesh.violation() == "");
  int locked = 0;
  for (std::uint32_t v = 0; v < 25; ++v) locked += mesh.kind(v) == VertexKind::locked ? 1 : 0;
  CHECK(locked > 0);
}

TEST_CASE("an edge of three faces is cut and locked, and its place is named") {
  const Mesh book = mesh_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  const CollapseMesh mesh(book, {});
  CHECK(mesh.violation() == "");
  CHECK(mesh.repair().non_manifold_edges.count == 1);
  CHECK(mesh.repair().non_manifold_edges.first == std::vector<std::uint32_t>{0});
  CHECK(mesh.kind(0) == VertexKind::locked);
  CHECK(mesh.kind(1) == VertexKind::locked);
  CHECK(mesh.vertex_capacity() == 9);  // three fans at each end of the edge: two more vertices each
  CHECK(mesh.origin(5) == 0);
  CHECK(mesh.origin(7) == 1);
}

TEST_CASE("two faces that run along an edge in the same direction") {
  const Mesh turned = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 3, 2}});
  const CollapseMesh mesh(turned, {});
  CHECK(mesh.violation() == "");
  CHECK(mesh.repair().inconsistent_edges.count == 1);
  CHECK(mesh.repair().non_manifold_edges.count == 0);
}

TEST_CASE("two cones that share a tip: the tip is two vertices at one place") {
  const Mesh bow_tie = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
  const CollapseMesh mesh(bow_tie, {});
  CHECK(mesh.violation() == "");
  CHECK(mesh.repair().non_manifold_vertices.count == 1);
  CHECK(mesh.repair().non_manifold_vertices.first == std::vector<std::uint32_t>{0});
  CHECK(mesh.vertex_capacity() == 6);
  CHECK(mesh.origin(5) == 0);
}

TEST_CASE("faces that name a vertex twice, or repeat an earlier face, are dropped") {
  Mesh mesh = square();
  mesh.faces.push_back({WedgeId(0u), WedgeId(1u), WedgeId(1u)});
  mesh.faces.push_back({WedgeId(1u), WedgeId(2u), WedgeId(0u)});
  mesh.positions.push_back({9, 9, 9});
  const CollapseMesh triangles(mesh, {});
  CHECK(triangles.violation() == "");
  CHECK(triangles.face_count() == 2);
  CHECK(triangles.repair().repeated_corners.first == std::vector<std::uint32_t>{2});
  CHECK(triangles.repair().duplicate_faces.first == std::vector<std::uint32_t>{3});
  CHECK(triangles.repair().unreferenced_vertices.first == std::vector<std::uint32_t>{4});
  CHECK_FALSE(triangles.repair().non_manifold());
}

TEST_CASE("violation() sees what is broken") {
  const Mesh grid = bumpy_grid(3, 0.1f, 1);
  CollapseMesh mesh(grid, {});
  // A corner vertex into the middle of the grid, off its curve: topologically possible, but the curve now has a gap in its kinds.
  const CollapseMesh::Edge edge = mesh.find_edge(0, 5);
  REQUIRE(edge.face_count() == 2);
  mesh.collapse(0, edge);
  CHECK(mesh.violation() != "");
}
