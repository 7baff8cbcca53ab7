#include <doctest/doctest.h>

#include "core/io/mesh_file.h"
#include "core/mesh/mesh_validation.h"
#include "core/mesh/weld.h"
#include "tests/support/skip.h"

using namespace etalon;

namespace {

/// v as the file stores it, so that signs are those of the published numbers.
MeshReport report_of(const std::filesystem::path& path, bool flip) {
  io::LoadedModel model = io::read_mesh(path);
  if (flip) io::flip_v(model.mesh);
  return validate_mesh(welded_by_position(model.mesh));
}

}  // namespace

TEST_CASE("the head scan") {
  const auto path = test::data_file("lee_perry_smith/LeePerrySmith.glb");
  if (!path) return test::report_skip("the head scan", "no LeePerrySmith.glb under $ETALON_DATA");
  const MeshReport report = report_of(*path, true);
  CHECK(report.vertex_count == 8844);
  CHECK(report.face_count == 17684);
  CHECK(report.closed());
  CHECK(report.manifold());
  CHECK(report.oriented());
  CHECK(report.genus == 0);
  CHECK(report.chart_count == 11);
  CHECK(report.largest_chart_faces == 15028);
  CHECK(report.seam_vertex_count == 371);
  CHECK(report.split_vertex_count == 362);  // 9 of the 371 are ends of cuts
  CHECK(report.negative_uv_faces == 662);
  CHECK(report.mirrored_charts.count == 2);
  CHECK(report.mirrored_chart_faces == 504);
  CHECK(report.folds.count == 158);
  CHECK(report.degenerate_uv_faces.count == 11);
  CHECK_FALSE(report.uv_outside.found());
  CHECK(report.tiny_charts.count == 2);
  CHECK(100 * report.uv_overlap_share >= 0.015);  // the published 0.02 %, to its last digit
  CHECK(100 * report.uv_overlap_share < 0.025);
}

TEST_CASE("spot") {
  const auto path = test::data_file("spot/spot_triangulated.obj");
  if (!path) return test::report_skip("spot", "no spot_triangulated.obj under $ETALON_DATA");
  const MeshReport report = report_of(*path, false);
  CHECK(report.vertex_count == 2930);
  CHECK(report.face_count == 5856);
  CHECK(report.closed());
  CHECK(report.manifold());
  CHECK(report.genus == 0);
  CHECK(report.chart_count == 13);
  CHECK(report.negative_uv_faces == 177);
  CHECK(report.mirrored_charts.count == 1);
  CHECK(report.mirrored_chart_faces == 176);
  CHECK(report.uv_outside.found());
}
