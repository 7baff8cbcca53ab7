#include "core/simplify/simplify.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/simplify/aps_metric.h"
#include "core/simplify/collapse_loop.h"
#include "core/simplify/hoppe_metric.h"
#include "core/simplify/qem5_metric.h"
#include "core/simplify/qem6_metric.h"
#include "tests/simplify/sample_meshes.h"

using namespace etalon;
using namespace etalon::simplify;
using namespace etalon::test;

namespace {

/// The least legal (cost, u, v) of all, by looking at every half-edge.
struct Least {
  double cost = std::numeric_limits<double>::infinity();
  std::uint32_t u = kNone, v = kNone;
};

template <class Metric>
Least least_of_all(const CollapseMesh& mesh, Metric& metric, Legality& legality) {
  Least least;
  for (std::uint32_t u = 0; u < mesh.vertex_capacity(); ++u) {
    if (!mesh.vertex_alive(u) || mesh.kind(u) == VertexKind::locked) continue;
    mesh.for_each_neighbor(u, [&](std::uint32_t v, std::uint32_t h) {
      if (mesh.kind(u) == VertexKind::curve && !mesh.on_curve(h)) return;
      const double cost = metric.cost(u, v, h);
      if (cost > least.cost || (cost == least.cost && (u > least.u || (u == least.u && v > least.v)))) return;
      if (legality.check(u, mesh.edge_from(u, h)) == Refusal::none) least = {cost, u, v};
    });
  }
  return least;
}

/// Collapses all there is, each step against the search of all half-edges.
template <class Metric>
void follow(CollapseMesh& mesh, const UnitPositions& positions, Metric& metric) {
  Legality legality(mesh, positions, {}), judge(mesh, positions, {});
  CollapseLoop<Metric> loop(mesh, metric, legality);
  for (int i = 0; i < 100000; ++i) {
    const Least expected = least_of_all(mesh, metric, judge);
    const auto step = loop.find();
    REQUIRE(step.u == expected.u);
    if (step.u == kNone) break;
    REQUIRE(step.v == expected.v);
    REQUIRE(step.cost == expected.cost);
    const std::uint32_t faces = mesh.face_count();
    loop.apply(step);
    REQUIRE(mesh.violation() == "");
    REQUIRE(mesh.face_count() + static_cast<std::uint32_t>(step.edge.face_count()) == faces);
    REQUIRE(loop.queue().ok());
  }
}

std::string message_of(const Mesh& mesh, const SimplifyOptions& options) {
  try {
    (void)simplify_mesh(mesh, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("each step is the least legal one of all, and keeps every invariant, down to the last") {
  for (NamedMesh sample : sample_meshes()) {
    CAPTURE(sample.name);
    Rng rng(17);
    for (std::size_t v = 0; v < sample.mesh.vertex_count(); ++v)
      sample.mesh.colors.push_back({rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0, 1), 1});
    const auto with = [&](const auto& make) {
      CollapseMesh mesh(sample.mesh, {});
      const UnitPositions positions = unit_positions(mesh);
      auto metric = make(mesh, positions);
      follow(mesh, positions, metric);
    };
    with([](const auto& mesh, const auto& positions) { return QemMetric(mesh, positions, {}); });
    with([](const auto& mesh, const auto& positions) { return KimMetric(mesh, positions, {}, {.unit = 0.1}); });
    with([](const auto& mesh, const auto& positions) { return Qem6Metric(mesh, positions, {}, 1); });
    with([](const auto& mesh, const auto& positions) { return HoppeMetric(mesh, positions, {}, 0.5); });
    if (!sample.mesh.has_uv) continue;
    with([](const auto& mesh, const auto& positions) { return Qem5Metric(mesh, positions, {}, 1); });
    with([](const auto& mesh, const auto& positions) { return ApsMetric(mesh, positions, {}); });
  }
}

TEST_CASE("a flat grid goes to the two triangles that its four corners need, without error") {
  const SimplifyResult result = simplify_mesh(bumpy_grid(12, 0, 1), {.target_faces = 2});
  CHECK(result.stop == StopReason::faces);
  CHECK(result.mesh.face_count() == 2);
  CHECK(result.mesh.vertex_count() == 4);
  CHECK(result.error == 0);
  for (const Vec3f& p : result.mesh.positions) CHECK((p.x == 0 || p.x == 1));
}

TEST_CASE("targets: reached, never passed by more than the last collapse; nothing to do; nothing left to do") {
  const Mesh sphere = bumpy_sphere(6, 0.2f, 3);  // 288 faces, closed: two faces a collapse
  for (const std::size_t target : {288u, 287u, 100u, 51u, 4u}) {
    CAPTURE(target);
    const SimplifyResult result = simplify_mesh(sphere, {.target_faces = target});
    CHECK(result.stop == StopReason::faces);
    CHECK(result.mesh.face_count() == target - target % 2);
    CHECK(result.collapse_count == (288 - result.mesh.face_count()) / 2);
    CHECK(validate_mesh(result.mesh).manifold());
    CHECK(validate_mesh(result.mesh).genus == 0);
  }
  const SimplifyResult more = simplify_mesh(sphere, {.target_faces = 1000});
  CHECK(more.mesh == sphere);
  CHECK(more.stop == StopReason::faces);
  const SimplifyResult all = simplify_mesh(sphere, {.target_faces = 0});
  CHECK(all.stop == StopReason::exhausted);
  CHECK(all.mesh.face_count() >= 4);
  CHECK(all.refusals[static_cast<std::size_t>(Refusal::last_faces)] + all.refusals[static_cast<std::size_t>(Refusal::flip_in_space)] > 0);
}

TEST_CASE("the result names its vertices and faces in the input") {
  const Mesh grid = seamed_grid(8, 0.2f, 4);
  const SimplifyResult result = simplify_mesh(grid, {.target_faces = 40});
  REQUIRE(result.source_vertex.size() == result.mesh.vertex_count());
  REQUIRE(result.source_face.size() == result.mesh.face_count());
  for (std::size_t v = 0; v < result.mesh.vertex_count(); ++v) {
    CHECK(result.mesh.positions[v] == grid.positions[result.source_vertex[v].index]);
    if (v > 0) CHECK(result.source_vertex[v - 1] < result.source_vertex[v]);
  }
  for (std::size_t f = 1; f < result.mesh.face_count(); ++f) CHECK(result.source_face[f - 1] < result.source_face[f]);
}

TEST_CASE("a seam stays a seam: closed in space, parted in texture, charts not turned") {
  const Mesh grid = seamed_grid(8, 0.2f, 4);
  const SimplifyResult result = simplify_mesh(grid, {.target_faces = 30});
  const MeshReport report = validate_mesh(result.mesh);
  CHECK(report.boundary_loop_count == 1);  // the outer border; a torn seam would be another
  CHECK(report.chart_count == 2);
  CHECK(report.mirrored_charts.count == 1);
  CHECK_FALSE(report.folds.found());
  CHECK_FALSE(report.degenerate_uv_faces.found());
  CHECK(result.curve_vertices == 30 + 7);
  CHECK(result.locked_vertices == 2);
}

TEST_CASE("where colours part, two pieces touch: they stay together") {
  // A bumpy grid, red on the left, blue on the right; the middle column once in each colour.
  const Mesh grid = bumpy_grid(8, 0.2f, 4);
  Mesh parted = grid;
  parted.has_uv = false;
  parted.colors.assign(grid.vertex_count(), {1, 0, 0, 1});
  std::vector<std::uint32_t> twin(grid.vertex_count(), kNone);
  for (auto& face : parted.faces) {
    float x = 0;
    for (const WedgeId w : face) x += grid.positions[grid.wedges[w.index].vertex.index].x / 3;
    if (x < 0.5f) continue;
    for (WedgeId& w : face) {
      const std::uint32_t v = grid.wedges[w.index].vertex.index;
      if (grid.positions[v].x > 0.5f) {
        parted.colors[v] = {0, 0, 1, 1};
        continue;
      }
      if (twin[v] == kNone) {
        twin[v] = static_cast<std::uint32_t>(parted.wedge_count());
        parted.wedges.push_back({VertexId(static_cast<std::uint32_t>(parted.vertex_count())), {0, 0}});
        parted.positions.push_back(grid.positions[v]);
        parted.colors.push_back({0, 0, 1, 1});
      }
      w = WedgeId(twin[v]);
    }
  }
  for (const CollapseKind collapse : {CollapseKind::half, CollapseKind::full}) {
    const SimplifyResult result = simplify_mesh(parted, {.metric = MetricName::qem6, .collapse = collapse, .target_faces = 40});
    CHECK(result.repair.color_seam_vertices.count == 18);
    CHECK(result.mesh.face_count() <= 60);
    int on_seam = 0;
    for (const Vec3f& p : result.mesh.positions) on_seam += p.x == 0.5f ? 1 : 0;
    CHECK(on_seam == 18);
  }
  // Of one colour they are not told apart from two pieces that happen to touch.
  parted.colors.assign(parted.vertex_count(), {1, 0, 0, 1});
  CHECK_FALSE(simplify_mesh(parted, {.target_faces = 40}).repair.color_seam_vertices.found());
}

TEST_CASE("locked vertices stay") {
  const Mesh sphere = bumpy_sphere(6, 0.2f, 3);
  std::vector<VertexId> locked;
  for (std::uint32_t v = 0; v < 20; ++v) locked.push_back(VertexId(7 * v));
  const SimplifyResult result = simplify_mesh(sphere, {.target_faces = 60, .locked = locked});
  for (const VertexId v : locked)
    CHECK(std::find(result.source_vertex.begin(), result.source_vertex.end(), v) != result.source_vertex.end());
}

TEST_CASE("non-manifold places stay, are counted, and can be refused with their place") {
  // Two bumpy spheres that share their first vertex.
  Mesh pair = bumpy_sphere(4, 0.1f, 1);
  const Mesh second = joined(pair, bumpy_sphere(4, 0.1f, 2), {2.2f, 0, 0});
  Mesh touching = second;
  const auto half = static_cast<std::uint32_t>(pair.vertex_count());
  for (Wedge& w : touching.wedges)
    if (w.vertex == VertexId(half + 1)) w.vertex = VertexId(0u);
  const SimplifyResult result = simplify_mesh(touching, {.target_faces = 40});
  CHECK(result.repair.non_manifold_vertices.count == 1);
  CHECK(result.repair.non_manifold_vertices.first == std::vector<std::uint32_t>{0});
  CHECK(result.repair.unreferenced_vertices.count == 1);
  CHECK(result.source_vertex[0] == VertexId(0u));
  CHECK(validate_mesh(result.mesh).non_manifold_vertices.count == 1);
  CHECK(validate_mesh(result.mesh).non_manifold_edges.count == 0);
  CHECK(message_of(touching, {.refuse_non_manifold = true}) ==
        "mesh: expected an oriented manifold, got 1 vertices whose faces are not one fan (first: vertex 0)");
  const Mesh book = mesh_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  CHECK(message_of(book, {.refuse_non_manifold = true}).find("1 edges of more than two faces (first: face 0)") != std::string::npos);
  const Mesh turned = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 3, 2}});
  CHECK(message_of(turned, {.refuse_non_manifold = true}).find("opposite orientation (first: face 0)") != std::string::npos);
}

TEST_CASE("bad input is refused with its place") {
  Mesh empty = square();
  empty.faces.clear();
  CHECK(message_of(empty, {}) == "mesh: expected at least one face, got none");
  Mesh nan = square();
  nan.positions[2].y = std::numeric_limits<float>::quiet_NaN();
  CHECK(message_of(nan, {}).find("vertex 2: position") == 0);
  Mesh infinite = square();
  infinite.wedges[1].uv.x = std::numeric_limits<float>::infinity();
  CHECK(message_of(infinite, {}).find("wedge 1: uv") == 0);
  Mesh vertex = square();
  vertex.wedges[3].vertex = VertexId(9u);
  CHECK(message_of(vertex, {}) == "wedge 3: vertex: expected below 4, got 9");
  Mesh wedge = square();
  wedge.faces[1][0] = WedgeId(7u);
  CHECK(message_of(wedge, {}) == "face 1: wedge: expected below 4, got 7");
  CHECK(message_of(square(), {.metric = MetricName::kim}) == "metric kim: expected vertex colours, got none");
  Mesh coloured = square();
  coloured.colors.assign(4, {1, 0, 0, 1});
  CHECK(message_of(coloured, {.metric = MetricName::kim, .kim = {.unit = -1}}).find("metric kim: unit") == 0);
  CHECK(message_of(square(), {.locked = {VertexId(4u)}}) == "locked vertex: expected below 4, got 4");
}

TEST_CASE("ratios") {
  CHECK(faces_for_ratio(100000, 0.1) == 10000);
  CHECK(faces_for_ratio(5, 0.5) == 3);
  CHECK(faces_for_ratio(7, 0) == 0);
  CHECK(faces_for_ratio(7, 1) == 7);
  CHECK_THROWS_AS((void)faces_for_ratio(7, 1.01), InputError);
  CHECK_THROWS_AS((void)faces_for_ratio(7, -0.01), InputError);
  CHECK_THROWS_AS((void)faces_for_ratio(7, std::numeric_limits<double>::quiet_NaN()), InputError);
}

TEST_CASE("observers see every collapse; the error is in model units") {
  Mesh sphere = bumpy_sphere(5, 0.2f, 8);
  std::size_t before = 0, after = 0;
  double last_cost = 0;
  const SimplifyResult result = simplify_mesh(sphere, {.target_faces = 50,
                                                       .before_collapse =
                                                           [&](const CollapseMesh& mesh, const CollapseEvent& event) {
                                                             ++before;
                                                             last_cost = std::max(last_cost, event.cost);
                                                             CHECK(mesh.vertex_alive(event.u));
                                                           },
                                                       .after_collapse =
                                                           [&](const CollapseMesh& mesh) {
                                                             ++after;
                                                             CHECK(mesh.violation() == "");
                                                           }});
  CHECK(before == result.collapse_count);
  CHECK(after == result.collapse_count);
  CHECK(last_cost == result.max_cost);
  CHECK(result.error > 0);
  for (Vec3f& p : sphere.positions) p = p * 8.0f;
  CHECK(simplify_mesh(sphere, {.target_faces = 50}).error == 8 * result.error);
  CHECK(result.state_bytes_per_vertex == 40);
}

TEST_CASE("the same bytes whatever the thread count") {
  const Mesh sphere = bumpy_sphere(9, 0.3f, 12);
  const Mesh first = simplify_mesh(sphere, {.target_faces = 100}).mesh;
  for (const int threads : {1, 2, 7}) {
    set_thread_count(threads);
    CHECK(simplify_mesh(sphere, {.target_faces = 100}).mesh == first);
  }
  set_thread_count(0);
}
