#include "core/mesh/adjacency.h"

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "tests/mesh/tiny_meshes.h"

using namespace etalon;
using namespace etalon::test;

TEST_CASE("a square: edges, opposites, one boundary loop") {
  const Mesh mesh = square();
  const Adjacency adjacency(mesh);
  CHECK(adjacency.node_count() == 4);
  CHECK(adjacency.edge_count() == 5);
  const HalfEdgeId diagonal = Adjacency::half_edge(FaceId(0u), 2);  // 2 → 0
  CHECK(adjacency.start(diagonal) == 2);
  CHECK(adjacency.end(diagonal) == 0);
  CHECK(adjacency.opposite(diagonal) == Adjacency::half_edge(FaceId(1u), 0));
  CHECK(adjacency.opposite(adjacency.opposite(diagonal)) == diagonal);
  CHECK_FALSE(adjacency.opposite(Adjacency::half_edge(FaceId(0u), 0)).valid());
  CHECK(adjacency.half_edges(adjacency.edge(diagonal)).size() == 2);

  const auto loops = adjacency.boundary_loops();
  REQUIRE(loops.size() == 1);
  std::vector<std::uint32_t> nodes;
  for (const HalfEdgeId h : loops[0]) nodes.push_back(adjacency.start(h));
  CHECK(nodes == std::vector<std::uint32_t>{0, 1, 2, 3});
  CHECK(adjacency.faces_around(0).size() == 2);
  CHECK(adjacency.faces_around(1).size() == 1);
}

TEST_CASE("closed meshes have an opposite everywhere and no boundary") {
  for (const Mesh& mesh : {tetrahedron(), torus()}) {
    const Adjacency adjacency(mesh);
    for (std::uint32_t h = 0; h < adjacency.half_edge_count(); ++h) {
      const HalfEdgeId other = adjacency.opposite(HalfEdgeId(h));
      REQUIRE(other.valid());
      CHECK(adjacency.start(other) == adjacency.end(HalfEdgeId(h)));
      CHECK(Adjacency::next(Adjacency::previous(HalfEdgeId(h))) == HalfEdgeId(h));
    }
    CHECK(adjacency.boundary_loops().empty());
    CHECK(adjacency.face_components().count == 1);
  }
}

TEST_CASE("components are numbered by their lowest face and joined by edges only") {
  // Faces 0 and 2 share an edge, face 1 touches them in a vertex, face 3 is alone.
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, -1, 0}, {1, 1, 0}, {5, 5, 5}, {6, 5, 5}, {5, 6, 5}},
                            {{0, 1, 2}, {0, 3, 4}, {2, 1, 5}, {6, 7, 8}});
  const auto components = Adjacency(mesh).face_components();
  CHECK(components.count == 3);
  CHECK(components.of_face == std::vector<std::uint32_t>{0, 1, 0, 2});
}

TEST_CASE("two triangles that touch in a vertex have two loops") {
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
  const auto loops = Adjacency(mesh).boundary_loops();
  REQUIRE(loops.size() == 2);
  CHECK(loops[0].size() == 3);
  CHECK(loops[1].size() == 3);
}

TEST_CASE("three faces on one edge: no opposite there, and every boundary half-edge is in exactly one loop") {
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  const Adjacency adjacency(mesh);
  const HalfEdgeId shared = Adjacency::half_edge(FaceId(0u), 0);
  CHECK(adjacency.half_edges(adjacency.edge(shared)).size() == 3);
  CHECK_FALSE(adjacency.opposite(shared).valid());
  std::size_t total = 0;
  for (const auto& loop : adjacency.boundary_loops()) total += loop.size();
  CHECK(total == 6);
}

TEST_CASE("a face that uses a vertex twice has no edge between the two, and is listed once around it") {
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}}, {{0, 0, 1}});
  const Adjacency adjacency(mesh);
  CHECK_FALSE(adjacency.edge(HalfEdgeId(0u)).valid());
  CHECK(adjacency.edge_count() == 1);
  CHECK(adjacency.faces_around(0).size() == 1);
}

TEST_CASE("over wedges a seam is a boundary") {
  Mesh mesh = square();
  set_corner_uv(mesh, 1, 0, {0.25f, 0.25f});
  CHECK(Adjacency(mesh).face_components().count == 1);
  const Adjacency by_wedge(mesh, Adjacency::Nodes::wedges);
  CHECK(by_wedge.face_components().count == 2);
  CHECK(by_wedge.edge_count() == 6);
}

TEST_CASE("adjacency checks its indices") {
  Mesh mesh = square();
  mesh.faces[0][0] = WedgeId();
  CHECK_THROWS_AS(Adjacency{mesh}, InternalError);
  mesh = square();
  mesh.wedges[0].vertex = VertexId(4u);
  CHECK_THROWS_AS(Adjacency{mesh}, InternalError);
}
