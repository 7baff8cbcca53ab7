// Real meshes: seams, folds, mirrored charts, boundaries, vertices of several fans.
#include <doctest/doctest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "core/io/mesh_file.h"
#include "core/mesh/mesh_validation.h"
#include "core/mesh/weld.h"
#include "core/simplify/simplify.h"
#include "tests/support/skip.h"

using namespace etalon;
using namespace etalon::simplify;

namespace {

struct Reduced {
  Mesh source;
  SimplifyResult result;
  MeshReport before, after;
};

/// Checks every invariant 20 times on the way down.
struct How {
  MetricName metric;
  CollapseKind collapse;
};

bool full_suite() { return std::getenv("ETALON_FULL") != nullptr && *std::getenv("ETALON_FULL") != '\0'; }

/// What a mesh of this kind can be simplified by; of the large ones the quick suite takes the two that move most.
std::vector<How> ways(bool colors, bool uv) {
  std::vector<How> result;
  for (const MetricName metric : kMetricNames) {
    const bool needs_uv = metric == MetricName::qem5 || metric == MetricName::aps;
    if (metric != MetricName::qem && (needs_uv ? !uv : !colors)) continue;
    result.push_back({metric, CollapseKind::half});
    if (metric != MetricName::kim && metric != MetricName::aps) result.push_back({metric, CollapseKind::full});
  }
  return result;
}

Reduced reduce(const std::filesystem::path& path, bool flip, double ratio, const How& how = {MetricName::qem, CollapseKind::half}) {
  Reduced reduced;
  io::LoadedModel model = io::read_mesh(path);
  if (flip) io::flip_v(model.mesh);
  reduced.source = welded_by_position(model.mesh);
  const std::size_t target = faces_for_ratio(reduced.source.face_count(), ratio);
  std::size_t step = 0;
  const std::size_t every = 1 + (reduced.source.face_count() - target) / 40;
  reduced.result = simplify_mesh(reduced.source, {.metric = how.metric,
                                                  .collapse = how.collapse,
                                                  .target_faces = target,
                                                  .record_landings = true,
                                                  .after_collapse = [&](const CollapseMesh& mesh) {
                                                    if (++step % every == 0) REQUIRE(mesh.violation() == "");
                                                  }});
  reduced.before = validate_mesh(reduced.source);
  reduced.after = validate_mesh(reduced.result.mesh);
  return reduced;
}

}  // namespace

TEST_CASE("the head scan: seams stay closed, charts keep their sides, folds do not grow") {
  const auto path = test::data_file("lee_perry_smith/LeePerrySmith.glb");
  if (!path) return test::report_skip("the head scan, simplified", "no LeePerrySmith.glb under $ETALON_DATA");
  for (const How& how : ways(false, true)) {
    CAPTURE(std::string(to_string(how.metric)));
    CAPTURE(std::string(to_string(how.collapse)));
    const Reduced head = reduce(*path, true, 0.1, how);
    CHECK(head.result.stop == StopReason::faces);
    CHECK(head.after.closed());
    CHECK(head.after.manifold());
    CHECK(head.after.oriented());
    CHECK(head.after.genus == 0);
    CHECK(head.after.mirrored_charts.count == 2);
    CHECK(head.after.folds.count <= head.before.folds.count);
    CHECK(head.after.degenerate_uv_faces.count <= head.before.degenerate_uv_faces.count);
    CHECK(head.after.chart_count == 11);
  }
}

TEST_CASE("spot, down to nothing") {
  const auto path = test::data_file("spot/spot_triangulated.obj");
  if (!path) return test::report_skip("spot, simplified", "no spot_triangulated.obj under $ETALON_DATA");
  for (const How& how : ways(false, true)) {
    CAPTURE(std::string(to_string(how.metric)));
    CAPTURE(std::string(to_string(how.collapse)));
    const Reduced spot = reduce(*path, false, 0, how);
    CHECK(spot.result.stop == StopReason::exhausted);
    CHECK(spot.after.closed());
    CHECK(spot.after.genus == 0);
    CHECK(spot.after.chart_count == 13);
    CHECK(spot.after.folds.count <= spot.before.folds.count);
  }
}

TEST_CASE("a Kinect frame: open, with holes, vertices of several fans") {
  const auto path = test::data_file("milk_carton/milk_carton_grid.ply");
  if (!path) return test::report_skip("the Kinect frame, simplified", "no milk_carton_grid.ply under $ETALON_DATA");
  const std::vector<How> quick{{MetricName::qem, CollapseKind::half}, {MetricName::hoppe, CollapseKind::full}};
  for (const How& how : full_suite() ? ways(true, false) : quick) {
    CAPTURE(std::string(to_string(how.metric)));
    CAPTURE(std::string(to_string(how.collapse)));
    const Reduced frame = reduce(*path, false, 0.1, how);
    CHECK(frame.result.repair.non_manifold_vertices.count == frame.before.non_manifold_vertices.count);
    CHECK(frame.after.non_manifold_vertices.count == frame.before.non_manifold_vertices.count);
    CHECK_FALSE(frame.after.non_manifold_edges.found());
    CHECK(frame.after.boundary_loop_count == frame.before.boundary_loop_count);
    CHECK(frame.after.component_count == frame.before.component_count);
    CHECK(frame.after.euler_characteristic == frame.before.euler_characteristic);
    if (how.metric == MetricName::qem) CHECK(*frame.result.distance_max < 0.005 * bounding_box(frame.source).diagonal());
  }
}

TEST_CASE("the coloured head scan: every metric, both kinds of collapse, and a tolerance that is kept") {
  const auto path = test::data_file("lee_perry_smith/lee_perry_smith_283k.ply");
  if (!path) return test::report_skip("the coloured head scan, simplified", "no lee_perry_smith_283k.ply under $ETALON_DATA");
  const std::vector<How> quick{{MetricName::qem, CollapseKind::half}, {MetricName::hoppe, CollapseKind::full}};
  for (const How& how : full_suite() ? ways(true, false) : quick) {
    CAPTURE(std::string(to_string(how.metric)));
    CAPTURE(std::string(to_string(how.collapse)));
    const Reduced head = reduce(*path, false, 0.1, how);
    CHECK(head.result.stop == StopReason::faces);
    CHECK(head.after.closed());
    CHECK(head.after.manifold());
    CHECK(head.after.oriented());
    CHECK(head.after.genus == 0);
  }
  if (!full_suite()) return test::report_skip("the coloured head scan within a tolerance", "20 seconds; set ETALON_FULL=1");
  const Mesh source = welded_by_position(io::read_mesh(*path).mesh);
  const double tolerance = 0.001 * bounding_box(source).diagonal();
  for (const CollapseKind collapse : {CollapseKind::half, CollapseKind::full}) {
    const SimplifyResult result = simplify_mesh(source, {.collapse = collapse, .tolerance = tolerance});
    CHECK(*result.distance_audited <= tolerance);
    CHECK(result.stop == StopReason::tolerance);
    CHECK(result.mesh.face_count() < source.face_count() / 20);
  }
}
