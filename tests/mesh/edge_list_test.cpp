#include "core/mesh/edge_list.h"

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/mesh/adjacency.h"
#include "tests/mesh/tiny_meshes.h"

using namespace etalon;
using namespace etalon::test;

TEST_CASE("each edge once, ascending") {
  CHECK(unique_edges(square()) == std::vector<VertexPair>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}});
  CHECK(unique_edges(tetrahedron()).size() == 6);
  CHECK(unique_edges(torus()).size() == Adjacency(torus()).edge_count());
}

TEST_CASE("sides between one vertex and itself are left out; indices out of range are a defect of the caller") {
  Mesh mesh = square();
  mesh.faces.push_back({WedgeId(3u), WedgeId(3u), WedgeId(1u)});
  CHECK(unique_edges(mesh).size() == 6);
  mesh.faces.push_back({WedgeId(4u), WedgeId(0u), WedgeId(1u)});
  CHECK_THROWS_AS((void)unique_edges(mesh), InternalError);
}
