// Real meshes: seams, folds, mirrored charts, boundaries, vertices of several fans.
#include <doctest/doctest.h>

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
Reduced reduce(const std::filesystem::path& path, bool flip, double ratio) {
  Reduced reduced;
  io::LoadedModel model = io::read_mesh(path);
  if (flip) io::flip_v(model.mesh);
  reduced.source = welded_by_position(model.mesh);
  const std::size_t target = faces_for_ratio(reduced.source.face_count(), ratio);
  std::size_t step = 0;
  const std::size_t every = 1 + (reduced.source.face_count() - target) / 40;
  reduced.result =
      simplify_mesh(reduced.source, {.target_faces = target, .record_landings = true, .after_collapse = [&](const CollapseMesh& mesh) {
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
  for (const double ratio : {0.5, 0.1, 0.03}) {
    CAPTURE(ratio);
    const Reduced head = reduce(*path, true, ratio);
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
  const Reduced spot = reduce(*path, false, 0);
  CHECK(spot.result.stop == StopReason::exhausted);
  CHECK(spot.after.closed());
  CHECK(spot.after.genus == 0);
  CHECK(spot.after.chart_count == 13);
  CHECK(spot.after.folds.count <= spot.before.folds.count);
}

TEST_CASE("a Kinect frame: open, with holes, vertices of several fans") {
  const auto path = test::data_file("milk_carton/milk_carton_grid.ply");
  if (!path) return test::report_skip("the Kinect frame, simplified", "no milk_carton_grid.ply under $ETALON_DATA");
  const Reduced frame = reduce(*path, false, 0.1);
  CHECK(frame.result.repair.non_manifold_vertices.count == frame.before.non_manifold_vertices.count);
  CHECK(frame.after.non_manifold_vertices.count == frame.before.non_manifold_vertices.count);
  CHECK_FALSE(frame.after.non_manifold_edges.found());
  CHECK(frame.after.boundary_loop_count == frame.before.boundary_loop_count);
  CHECK(frame.after.component_count == frame.before.component_count);
  CHECK(frame.after.euler_characteristic == frame.before.euler_characteristic);
  CHECK(*frame.result.distance_max < 0.005 * bounding_box(frame.source).diagonal());
}
