#include "core/mesh/mesh_validation.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/mesh/tiny_meshes.h"

using namespace etalon;
using namespace etalon::test;

namespace {

bool says(const MeshReport& report, const std::string& text) {
  for (const std::string& line : report.to_lines())
    if (line.find(text) != std::string::npos) return true;
  return false;
}

using Places = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("a sound square has nothing to report but its boundary") {
  const MeshReport report = validate_mesh(square());
  CHECK(report.vertex_count == 4);
  CHECK(report.edge_count == 5);
  CHECK(report.euler_characteristic == 1);
  CHECK(report.boundary_loop_count == 1);
  CHECK(report.boundary_edges.count == 4);
  CHECK_FALSE(report.closed());
  CHECK(report.manifold());
  CHECK(report.oriented());
  CHECK_FALSE(report.genus.has_value());
  CHECK(report.chart_count == 1);
  CHECK(report.uv_coverage == 1);
  for (const Defect* d : {&report.wedges_out_of_range, &report.non_finite_vertices, &report.non_finite_wedges,
                          &report.unreferenced_vertices, &report.non_manifold_edges, &report.non_manifold_vertices,
                          &report.inconsistent_edges, &report.duplicate_faces, &report.degenerate_faces, &report.degenerate_uv_faces,
                          &report.folds, &report.mirrored_charts, &report.tiny_charts, &report.uv_outside, &report.uv_overlaps})
    CHECK_FALSE(d->found());
  CHECK(says(report, "open, 1 boundary loops, manifold"));
}

TEST_CASE("genus of closed meshes") {
  CHECK(validate_mesh(tetrahedron()).genus == 0);
  CHECK(validate_mesh(torus()).genus == 1);
  CHECK(says(validate_mesh(torus()), "closed, manifold, consistently oriented, genus 1"));
}

TEST_CASE("indices out of range end the examination") {
  Mesh mesh = square();
  mesh.faces[1][0] = WedgeId(99u);
  MeshReport report = validate_mesh(mesh);
  CHECK(report.wedges_out_of_range.first == Places{1});
  CHECK_FALSE(report.indices_in_range);
  CHECK_FALSE(report.closed());
  CHECK(says(report, "indices out of range: 1 (faces 1)"));
  mesh = square();
  mesh.wedges[0].vertex = VertexId(4u);
  report = validate_mesh(mesh);
  CHECK(report.wedges_out_of_range.count == 2);
}

TEST_CASE("values that are not finite") {
  Mesh mesh = square();
  mesh.positions[2].z = std::nanf("");
  mesh.wedges[1].uv.x = INFINITY;
  mesh.colors.assign(4, Vec4f(1, 1, 1, 1));
  mesh.colors[3].w = INFINITY;
  const MeshReport report = validate_mesh(mesh);
  CHECK(report.non_finite_vertices.first == Places{2, 3});
  CHECK(report.non_finite_wedges.first == Places{1});
  CHECK(report.chart_count == 0);
  CHECK(says(report, "not finite: 2 (vertices 2 3)"));
}

TEST_CASE("a vertex of no face") {
  Mesh mesh = square();
  mesh.positions.push_back({5, 5, 5});
  const MeshReport report = validate_mesh(mesh);
  CHECK(report.unreferenced_vertices.first == Places{4});
  CHECK(report.euler_characteristic == 1);
}

TEST_CASE("an edge of three faces") {
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  const MeshReport report = validate_mesh(mesh);
  CHECK(report.non_manifold_edges.count == 1);
  CHECK(report.non_manifold_edges.first == Places{0});
  CHECK(report.non_manifold_vertices.count == 0);  // the faces still hang together around every vertex
  CHECK_FALSE(report.manifold());
}

TEST_CASE("two fans at one vertex") {
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
  const MeshReport report = validate_mesh(mesh);
  CHECK(report.non_manifold_vertices.first == Places{0});
  CHECK(report.non_manifold_edges.count == 0);
  CHECK_FALSE(report.manifold());
}

TEST_CASE("a face turned around") {
  Mesh mesh = tetrahedron();
  std::swap(mesh.faces[2][0], mesh.faces[2][1]);
  const MeshReport report = validate_mesh(mesh);
  CHECK(report.inconsistent_edges.count == 3);
  CHECK_FALSE(report.oriented());
  CHECK_FALSE(report.genus.has_value());
  CHECK(says(report, "inconsistently oriented"));
}

TEST_CASE("a face twice, in either orientation") {
  Mesh mesh = square();
  mesh.faces.push_back({mesh.faces[0][1], mesh.faces[0][0], mesh.faces[0][2]});
  const MeshReport report = validate_mesh(mesh);
  CHECK(report.duplicate_faces.first == Places{2});
}

TEST_CASE("faces without area in space are found exactly") {
  Mesh mesh = mesh_of({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {3, 3, 3.0000002f}}, {{0, 1, 2}, {0, 1, 3}, {1, 1, 2}});
  const MeshReport report = validate_mesh(mesh);
  CHECK(report.degenerate_faces.first == Places{0, 2});
}

TEST_CASE("texture space: flat, folded, mirrored, tiny, outside, overlapping") {
  Mesh mesh = square();
  mesh.wedges[3].uv = {0.5f, 0.5f};
  CHECK(validate_mesh(mesh).degenerate_uv_faces.first == Places{1});

  mesh.wedges[3].uv = {0.75f, 0.25f};
  MeshReport report = validate_mesh(mesh, {.overlap_grid = 4});
  CHECK(report.folds.first == Places{1});
  CHECK(report.negative_uv_faces == 1);
  CHECK(report.mirrored_chart_faces == 0);
  CHECK(report.uv_overlaps.count == 2);
  CHECK(report.uv_overlap_share == 0.5);  // of the 10 cells with y <= x, the folded face owns (0,0) (1,1) (2,1) (2,2) (3,3)
  CHECK(says(report, "folds: faces against their chart's orientation: 1 (faces 1)"));

  mesh = square();
  for (Wedge& w : mesh.wedges) w.uv.x = 1 - w.uv.x;
  report = validate_mesh(mesh);
  CHECK(report.mirrored_charts.first == Places{0});
  CHECK(report.mirrored_chart_faces == 2);
  CHECK(report.negative_uv_faces == 2);
  CHECK(report.folds.count == 0);
  CHECK(says(report, "faces of negative UV area: 2, of which 2 in mirrored charts"));

  mesh = square();
  for (Wedge& w : mesh.wedges) w.uv *= 1.0f / 1024;
  CHECK_FALSE(validate_mesh(mesh).tiny_charts.found());  // exactly one texel
  CHECK(validate_mesh(mesh, {.texture_width = 512, .texture_height = 1024}).tiny_charts.first == Places{0});

  mesh = square();
  mesh.wedges[2].uv = {1.0000001f, 1};
  mesh.wedges.push_back({VertexId(0u), {7, 7}});  // used by no face
  CHECK(validate_mesh(mesh).uv_outside.first == Places{2});
}

TEST_CASE("a mesh without texture coordinates and an empty one") {
  Mesh mesh = tetrahedron();
  mesh.has_uv = false;
  CHECK(validate_mesh(mesh).chart_count == 0);
  CHECK(says(validate_mesh(mesh), "no texture coordinates"));
  const MeshReport empty = validate_mesh(Mesh{});
  CHECK_FALSE(empty.closed());
  CHECK(empty.edge_count == 0);
}

TEST_CASE("at most list_limit places are named") {
  Mesh mesh;
  mesh.positions.assign(20, {0, 0, 0});
  const MeshReport report = validate_mesh(mesh, {.list_limit = 3});
  CHECK(report.unreferenced_vertices.count == 20);
  CHECK(report.unreferenced_vertices.first == Places{0, 1, 2});
  CHECK(says(report, "vertices of no face: 20 (vertices 0 1 2 …)"));
}
