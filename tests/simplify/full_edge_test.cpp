// Full-edge collapses: strict order, places, seams, landings.
#include "core/simplify/full_edge_loop.h"

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/simplify/hoppe_metric.h"
#include "core/simplify/qem5_metric.h"
#include "core/simplify/qem6_metric.h"
#include "core/simplify/simplify.h"
#include "tests/simplify/sample_meshes.h"

using namespace etalon;
using namespace etalon::simplify;
using namespace etalon::test;

namespace {

Mesh with_colors(Mesh mesh) {
  Rng rng(17);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    mesh.colors.push_back({rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0, 1)});
  return mesh;
}

/// The least legal (cost, lower end, higher end) of all edges, by looking at each.
template <class Metric>
struct Least {
  double cost = std::numeric_limits<double>::infinity();
  std::uint32_t low = kNone, high = kNone;

  Least(const CollapseMesh& mesh, const UnitPositions& positions, const Metric& metric, const FullEdgeLoop<Metric>& loop,
        Legality& legality) {
    for (std::uint32_t a = 0; a < mesh.vertex_capacity(); ++a) {
      if (!mesh.vertex_alive(a)) continue;
      mesh.for_each_neighbor(a, [&](std::uint32_t b, std::uint32_t h) {
        if (b < a) return;
        const auto way = loop.way_of(a, b, h);
        if (way.u == kNone) return;
        Placement placement;
        if (way.moves) placement = metric.place(way.u, way.v, way.edge);
        const double here = way.moves ? placement.cost : metric.cost(way.u, way.v, h);
        if (here > cost || (here == cost && (a > low || (a == low && b > high)))) return;
        Refusal refusal = Refusal::none;
        if (way.moves) {
          MovedVertex moved = carried(mesh, positions, way.u, way.v, way.edge, placement.at);
          metric.adopt(placement, way.u, way.v, way.edge, moved);
          refusal = legality.check_move(way.u, way.v, way.edge, moved);
        } else {
          refusal = legality.check(way.u, way.edge);
        }
        if (refusal != Refusal::none) return;
        cost = here;
        low = a;
        high = b;
      });
    }
  }
};

template <class Metric>
void follow(const Mesh& source, double weight) {
  CollapseMesh mesh(source, {});
  mesh.allow_moves();
  UnitPositions positions = unit_positions(mesh);
  Metric metric = [&] {
    if constexpr (std::is_same_v<Metric, QemMetric>)
      return Metric(mesh, positions, {});
    else
      return Metric(mesh, positions, {}, weight);
  }();
  Legality legality(mesh, positions, {}), judge(mesh, positions, {});
  FullEdgeLoop<Metric> loop(mesh, positions, metric, legality);
  for (;;) {
    const Least<Metric> expected(mesh, positions, metric, loop, judge);
    const auto step = loop.find();
    REQUIRE((step.u == kNone) == (expected.low == kNone));
    if (step.u == kNone) break;
    REQUIRE(std::min(step.u, step.v) == expected.low);
    REQUIRE(std::max(step.u, step.v) == expected.high);
    REQUIRE(step.cost == expected.cost);
    const std::uint32_t faces = mesh.face_count();
    loop.apply(step);
    REQUIRE(mesh.violation() == "");
    REQUIRE(mesh.face_count() + static_cast<std::uint32_t>(step.edge.face_count()) == faces);
    REQUIRE(loop.queue().ok());
    const Vec3f& at = mesh.position(step.v);
    REQUIRE(model_place(positions, positions.at[step.v]) == at);
  }
}

}  // namespace

TEST_CASE("each step is the least legal edge of all, and keeps every invariant, down to the last") {
  for (const NamedMesh& sample : sample_meshes()) {
    CAPTURE(sample.name);
    const Mesh mesh = with_colors(sample.mesh);
    follow<QemMetric>(mesh, 1);
    follow<Qem6Metric>(mesh, 1);
    follow<HoppeMetric>(mesh, 0.5);
    if (mesh.has_uv) follow<Qem5Metric>(mesh, 1);
  }
}

TEST_CASE("three planes: the new vertex is where they meet") {
  // A cube's corner, cut off: the triangle 0 1 2 between three faces of a large corner at (1, 1, 1).
  Quadric3<double> q;
  add_plane_at_origin(q, {1, 0, 0}, 2);
  const Quadric3<double> from = sum(moved(q, Vec3d(-1, 0, 0)), moved(
                                                                   [] {
                                                                     Quadric3<double> p;
                                                                     add_plane_at_origin(p, {0, 1, 0}, 1);
                                                                     add_plane_at_origin(p, {0, 0, 1}, 3);
                                                                     return p;
                                                                   }(),
                                                                   Vec3d(0, -2, 4)));
  const Placement placement = place_vertex(Vec3f(0, 0, 0), Vec3f(1, 0, 0), std::span(&from, 1), {}, NoAttributes{});
  CHECK(placement.at == Vec3f(1, 2, -4));
  CHECK(placement.cost == 0);
}

TEST_CASE("flat or straight: the best of the ends and the middle, v first") {
  Quadric3<double> plane;
  add_plane_at_origin(plane, {0, 0, 1}, 1);
  const auto place = [](const Quadric3<double>& q) {
    return place_vertex(Vec3f(1, 1, 1), Vec3f(3, 1, 1), std::span(&q, 1), {}, NoAttributes{});
  };
  CHECK(place(plane).at == Vec3f(1, 1, 1));  // all equal: v
  Quadric3<double> line = plane;
  add_plane_at_origin(line, {1, 0, 0}, 1);
  CHECK(place(moved(line, Vec3d(-2, 0, 0))).at == Vec3f(3, 1, 1));
  CHECK(place(moved(line, Vec3d(-1.1, 0, 0))).at == Vec3f(2, 1, 1));
  CHECK(place(moved(line, Vec3d(-1.1, 0, 0))).cost == doctest::Approx(0.01).epsilon(1e-12));
}

TEST_CASE("a flat grid goes to two triangles, without error; a boundary stays where it is") {
  for (const MetricName metric : {MetricName::qem, MetricName::qem5}) {
    const SimplifyResult result =
        simplify_mesh(bumpy_grid(12, 0, 1), {.metric = metric, .collapse = CollapseKind::full, .target_faces = 2});
    CHECK(result.stop == StopReason::faces);
    CHECK(result.mesh.face_count() == 2);
    CHECK(result.error < 1e-6);
    for (const Vec3f& p : result.mesh.positions) CHECK((p.x == 0 || p.x == 1));
  }
}

TEST_CASE("a sphere: nearer with full-edge collapses than with half-edge ones") {
  const Mesh sphere = bumpy_sphere(16, 0, 3);
  const auto volume = [](const Mesh& mesh) {
    double sum = 0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
      sum += dot_product(to_double(mesh.position(FaceId(f), 0)),
                         cross_product(to_double(mesh.position(FaceId(f), 1)), to_double(mesh.position(FaceId(f), 2)))) /
             6;
    return sum;
  };
  const double before = volume(sphere);
  const SimplifyResult half = simplify_mesh(sphere, {.target_faces = 200});
  const SimplifyResult full = simplify_mesh(sphere, {.collapse = CollapseKind::full, .target_faces = 200});
  CHECK(full.mesh.face_count() == 200);
  CHECK(2 * std::abs(volume(full.mesh) - before) < std::abs(volume(half.mesh) - before));
  CHECK(full.max_cost < half.max_cost);
  CHECK(validate_mesh(full.mesh).manifold());
  CHECK(validate_mesh(full.mesh).genus == 0);
}

TEST_CASE("a seam stays a seam: closed in space, parted in texture, charts not turned, with every metric") {
  const Mesh grid = with_colors(seamed_grid(8, 0.2f, 4));
  for (const MetricName metric : {MetricName::qem, MetricName::qem5, MetricName::qem6, MetricName::hoppe}) {
    CAPTURE(to_string(metric));
    const SimplifyResult result =
        simplify_mesh(grid, {.metric = metric, .collapse = CollapseKind::full, .target_faces = 40, .record_landings = true});
    CHECK(result.stop == StopReason::faces);
    const MeshReport report = validate_mesh(result.mesh);
    CHECK(report.boundary_loop_count == 1);
    CHECK(report.chart_count == 2);
    CHECK(report.mirrored_charts.count == 1);
    CHECK_FALSE(report.folds.found());
    CHECK_FALSE(report.degenerate_uv_faces.found());
    for (const Vec4f& c : result.mesh.colors) CHECK((std::min({c.x, c.y, c.z, c.w}) >= 0 && std::max({c.x, c.y, c.z, c.w}) <= 1));
    for (const Wedge& w : result.mesh.wedges) {
      // Texture coordinates follow: u = x on the left, 3 − x on the right, v = y; never farther off than the surface is bumpy.
      const Vec3f& p = result.mesh.positions[w.vertex.index];
      const float x = w.uv.x > 1.5f ? 3 - w.uv.x : w.uv.x;
      CHECK(std::abs(x - p.x) < 0.1f);
      CHECK(std::abs(w.uv.y - p.y) < 0.1f);
    }
  }
}

TEST_CASE("colours come along where the metric does not hold them") {
  // Red is x: still so after any number of collapses on a plane.
  Mesh grid = bumpy_grid(10, 0, 1);
  for (const Vec3f& p : grid.positions) grid.colors.push_back({p.x, 0.5f, 1 - p.y, 1});
  const SimplifyResult result = simplify_mesh(grid, {.collapse = CollapseKind::full, .target_faces = 30});
  for (std::size_t v = 0; v < result.mesh.vertex_count(); ++v) {
    CHECK(result.mesh.colors[v].x == doctest::Approx(result.mesh.positions[v].x).epsilon(1e-5));
    CHECK(result.mesh.colors[v].z == doctest::Approx(1 - result.mesh.positions[v].y).epsilon(1e-5));
  }
}

TEST_CASE("locked vertices stay where they are") {
  const Mesh sphere = bumpy_sphere(6, 0.2f, 3);
  std::vector<VertexId> locked;
  for (std::uint32_t v = 0; v < 20; ++v) locked.push_back(VertexId(7 * v));
  const SimplifyResult result = simplify_mesh(sphere, {.collapse = CollapseKind::full, .target_faces = 60, .locked = locked});
  for (const VertexId v : locked) {
    const auto at = std::find(result.source_vertex.begin(), result.source_vertex.end(), v);
    REQUIRE(at != result.source_vertex.end());
    CHECK(result.mesh.positions[static_cast<std::size_t>(at - result.source_vertex.begin())] == sphere.positions[v.index]);
  }
}

TEST_CASE("kim is of half-edge collapses; wedges that differ in nothing must be welded") {
  const Mesh sphere = with_colors(bumpy_sphere(3, 0.2f, 3));
  CHECK_THROWS_WITH_AS((void)simplify_mesh(sphere, {.metric = MetricName::kim, .collapse = CollapseKind::full}),
                       "metric kim: expected half-edge collapses, got full-edge: it says nothing of places between vertices", InputError);
  Mesh twice = bumpy_grid(3, 0, 1);
  twice.wedges.push_back(twice.wedges[5]);
  for (auto& w : twice.faces[2])
    if (w == WedgeId(5u)) w = WedgeId(static_cast<std::uint32_t>(twice.wedge_count() - 1));
  for (auto& w : twice.faces[8])
    if (w == WedgeId(5u)) w = WedgeId(static_cast<std::uint32_t>(twice.wedge_count() - 1));
  CHECK_NOTHROW((void)simplify_mesh(twice, {.target_faces = 4}));
  CHECK_THROWS_WITH_AS((void)simplify_mesh(twice, {.collapse = CollapseKind::full, .target_faces = 4}),
                       "vertex 5: expected one wedge on each side of its curve, got two of equal uv: weld first", InputError);
  CHECK_THROWS_AS((void)simplify_mesh(twice, {.metric = MetricName::qem5, .target_faces = 4}), InputError);
}

TEST_CASE("full-edge: the same bytes whatever the thread count, and whatever the scale by powers of two") {
  Mesh sphere = with_colors(bumpy_sphere(9, 0.3f, 12));
  const SimplifyOptions options{.metric = MetricName::qem6, .collapse = CollapseKind::full, .target_faces = 100};
  const Mesh first = simplify_mesh(sphere, options).mesh;
  for (const int threads : {1, 2, 7}) {
    set_thread_count(threads);
    CHECK(simplify_mesh(sphere, options).mesh == first);
  }
  set_thread_count(0);
  for (Vec3f& p : sphere.positions) p = p * 0x1p+70f;
  Mesh large = simplify_mesh(sphere, options).mesh;
  for (Vec3f& p : large.positions) p = p * 0x1p-70f;
  CHECK(large == first);
}
