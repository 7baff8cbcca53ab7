// Where the scan's vertices land: near, connected with where the collapses took them, the same for every thread count.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/bake/vertex_landings.h"
#include "core/base/parallel.h"
#include "core/mesh/adjacency.h"
#include "core/mesh/triangle_tree.h"
#include "core/procedural/knot.h"
#include "tests/bake/fill_fixture.h"

using namespace etalon;
using namespace etalon::bake;

namespace {

struct Decimated {
  simplify::SimplifyResult result;
  std::vector<std::uint32_t> survivors;
  std::vector<Landing> landings;
};

Decimated decimate(const Mesh& scan, std::size_t faces) {
  CollapseTrail trail(scan.vertex_count());
  simplify::SimplifyOptions how{.target_faces = faces};
  how.before_collapse = [&](const simplify::CollapseMesh& mesh, const simplify::CollapseEvent& event) { trail.record(mesh, event); };
  Decimated all{.result = simplify::simplify_mesh(scan, how), .survivors = {}, .landings = {}};
  all.survivors = trail.survivors(all.result);
  all.landings = land_vertices(scan, all.result, trail);
  return all;
}

const Mesh& knot() {
  static const Mesh mesh = procedural::make_knot({.rings = 200, .around = 40});
  return mesh;
}

// Two sheets of n × n squares, one above the other by less than they are uneven.
Mesh sheets(int n, float apart) {
  Mesh mesh;
  for (int sheet = 0; sheet < 2; ++sheet) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const float x = static_cast<float>(i) / static_cast<float>(n), y = static_cast<float>(j) / static_cast<float>(n);
        const float bump = 0.05f * static_cast<float>((i * 7 + j * 11) % 5) / 4;
        mesh.positions.push_back({x, y, bump + apart * static_cast<float>(sheet)});
        mesh.wedges.push_back({.vertex = VertexId(mesh.positions.size() - 1)});
      }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const auto a = first + static_cast<std::uint32_t>(j * (n + 1) + i), up = a + static_cast<std::uint32_t>(n + 1);
        mesh.faces.push_back({WedgeId(a), WedgeId(a + 1), WedgeId(up + 1)});
        mesh.faces.push_back({WedgeId(a), WedgeId(up + 1), WedgeId(up)});
      }
  }
  return mesh;
}

}  // namespace

TEST_CASE("a vertex that is still there lands on itself; no neighbouring triangle is nearer than a landing; most are the nearest of all") {
  const Decimated all = decimate(knot(), 300);
  const Mesh& mesh = all.result.mesh;
  REQUIRE(mesh.face_count() <= 300);
  const Adjacency adjacency(mesh);
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const Landing& landing = all.landings[all.result.source_vertex[v].index];
    CHECK(all.survivors[all.result.source_vertex[v].index] == v);
    CHECK(landing_point(mesh, landing) == to_double(mesh.positions[v]));
    CHECK(landing.face == adjacency.faces_around(v)[0]);
  }
  const TriangleTree tree(mesh);
  std::size_t nearest = 0;
  for (std::size_t v = 0; v < all.landings.size(); ++v) {
    const Landing& landing = all.landings[v];
    REQUIRE(landing.face.valid());
    const Vec3d p = to_double(knot().positions[v]);
    const double distance2 = squared_distance(p, landing_point(mesh, landing));
    for (int c = 0; c < 3; ++c)
      for (const FaceId f : adjacency.faces_around(mesh.vertex(landing.face, c).index)) {
        const NearestOnTriangle there =
            nearest_on_triangle(p, to_double(mesh.position(f, 0)), to_double(mesh.position(f, 1)), to_double(mesh.position(f, 2)));
        REQUIRE(there.distance2 >= distance2 * (1 - 1e-12));
      }
    nearest += tree.nearest(p).face == landing.face ? 1 : 0;
  }
  CHECK(nearest > all.landings.size() * 9 / 10);
  double largest = 0;
  for (std::size_t v = 0; v < all.landings.size(); ++v)
    largest = std::max(largest, std::sqrt(squared_distance(to_double(knot().positions[v]), landing_point(mesh, all.landings[v]))));
  CHECK(largest_distance(knot(), mesh, all.landings) == largest);
}

TEST_CASE("a landing stays on its own sheet, though the other one is nearer for many") {
  const Mesh scan = sheets(24, 0.02f);
  const Decimated all = decimate(scan, 40);
  const Mesh& mesh = all.result.mesh;
  const auto sheet_of = [](const Adjacency::Components& parts, FaceId f) { return parts.of_face[f.index]; };
  const Adjacency::Components parts = Adjacency(mesh).face_components();
  REQUIRE(parts.count == 2);
  const TriangleTree tree(mesh);
  std::uint32_t of_sheet[2] = {2, 2};
  std::size_t other = 0;
  for (std::size_t v = 0; v < scan.vertex_count(); ++v) {
    const std::uint32_t part = sheet_of(parts, all.landings[v].face);
    std::uint32_t& expected = of_sheet[v < scan.vertex_count() / 2 ? 0 : 1];
    if (expected == 2) expected = part;
    CHECK(part == expected);
    other += sheet_of(parts, tree.nearest(to_double(scan.positions[v])).face) != expected ? 1 : 0;
  }
  CHECK(of_sheet[0] != of_sheet[1]);
  CHECK(other > 50);  // what the whole surface's nearest points would mix up
}

TEST_CASE("vertices that share a place land in triangles of their own") {
  // 8 × 8 quads, each triangle with corners of its own; nothing collapses, and most places are six vertices'.
  Mesh scan;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (const auto& triangle :
           {std::array{std::pair(0, 0), std::pair(1, 0), std::pair(1, 1)}, {std::pair(0, 0), std::pair(1, 1), std::pair(0, 1)}}) {
        std::array<WedgeId, 3> face;
        for (std::size_t c = 0; c < 3; ++c) {
          scan.positions.push_back({static_cast<float>(x + triangle[c].first), static_cast<float>(y + triangle[c].second), 0});
          scan.wedges.push_back({.vertex = VertexId(scan.positions.size() - 1)});
          face[c] = WedgeId(scan.wedges.size() - 1);
        }
        scan.faces.push_back(face);
      }
  const Decimated all = decimate(scan, scan.face_count());
  REQUIRE(all.result.mesh.face_count() == scan.face_count());
  for (std::size_t v = 0; v < scan.vertex_count(); ++v) CHECK(all.landings[v].face.index == v / 3);
}

TEST_CASE("vertices without a face land nowhere; those of one that is no manifold somewhere; the same for every thread count") {
  Mesh scan = test::fins();
  scan.positions.push_back({9, 9, 9});
  scan.wedges.push_back({.vertex = VertexId(scan.positions.size() - 1)});
  const Decimated fins = decimate(scan, 1);
  for (std::size_t v = 0; v < scan.vertex_count(); ++v) CHECK(fins.landings[v].face.valid() == (v + 1 < scan.vertex_count()));
  CHECK(fins.survivors.back() == simplify::kNone);
  const Decimated all = decimate(knot(), 100);
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    const Decimated again = decimate(knot(), 100);
    for (std::size_t v = 0; v < all.landings.size(); ++v) {
      REQUIRE(again.landings[v].face == all.landings[v].face);
      REQUIRE(again.landings[v].weights == all.landings[v].weights);
    }
  }
  set_thread_count(0);
}
