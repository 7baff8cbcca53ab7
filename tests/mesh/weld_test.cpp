#include "core/mesh/weld.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/error.h"
#include "tests/mesh/tiny_meshes.h"

using namespace etalon;
using namespace etalon::test;

TEST_CASE("welding makes one square of two loose triangles, in order of first appearance") {
  const Mesh loose = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {3, 4, 5}});
  const Mesh welded = welded_by_position(loose);
  CHECK(welded == square());
  CHECK(welded_by_position(welded) == welded);
}

TEST_CASE("vertices at one place with different texture coordinates become wedges of one vertex") {
  Mesh loose = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {3, 4, 5}});
  loose.wedges[3].uv = {0.5f, 0.5f};
  const Mesh welded = welded_by_position(loose);
  CHECK(welded.vertex_count() == 4);
  CHECK(welded.wedge_count() == 5);
  CHECK(welded.wedge(FaceId(0u), 0).vertex == welded.wedge(FaceId(1u), 0).vertex);
  CHECK(welded.wedge(FaceId(1u), 0).uv == Vec2f(0.5f, 0.5f));
  loose.has_uv = false;  // then uv means nothing
  CHECK(welded_by_position(loose).wedge_count() == 4);
}

TEST_CASE("different colours keep vertices apart") {
  Mesh loose = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {3, 4, 5}});
  loose.colors.assign(6, Vec4f(0.5f, 0.5f, 0.5f, 1));
  CHECK(welded_by_position(loose).vertex_count() == 4);
  loose.colors[3].y = 0.25f;
  const Mesh welded = welded_by_position(loose);
  CHECK(welded.vertex_count() == 5);
  CHECK(welded.colors[3].y == 0.25f);
}

TEST_CASE("zero equals minus zero, a NaN equals its own bits, and the first value stays") {
  const float nan = std::nanf("");
  Mesh loose = mesh_of({{-0.0f, nan, 0}, {0.0f, nan, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 2, 3}, {1, 2, 3}});
  for (Wedge& w : loose.wedges) w.uv = {0, 0};
  const Mesh welded = welded_by_position(loose);
  CHECK(welded.vertex_count() == 3);
  CHECK(std::signbit(welded.positions[0].x));
  CHECK(welded.faces[0] == welded.faces[1]);
}

TEST_CASE("unreferenced vertices, materials and face order stay") {
  Mesh mesh = square();
  mesh.positions.push_back({9, 9, 9});
  mesh.face_materials = {3, 1};
  const Mesh welded = welded_by_position(mesh);
  CHECK(welded.vertex_count() == 5);
  CHECK(welded.face_materials == std::vector<std::uint32_t>{3, 1});
}

TEST_CASE("welding refuses indices out of range") {
  Mesh mesh = square();
  mesh.faces[1][2] = WedgeId(4u);
  CHECK_THROWS_WITH_AS((void)welded_by_position(mesh), "face 1: wedge: expected below 4, got 4", InputError);
  mesh = square();
  mesh.wedges[2].vertex = VertexId(7u);
  CHECK_THROWS_WITH_AS((void)welded_by_position(mesh), "wedge 2: vertex: expected below 4, got 7", InputError);
}
