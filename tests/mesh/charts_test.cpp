#include "core/mesh/charts.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/error.h"
#include "tests/mesh/tiny_meshes.h"

using namespace etalon;
using namespace etalon::test;

TEST_CASE("one chart, its area on a texture") {
  const Charts charts = find_charts(square());
  REQUIRE(charts.charts.size() == 1);
  CHECK(charts.charts[0].sign == 1);
  CHECK(charts.charts[0].area_uv == 1);
  CHECK(charts.charts[0].area_texels(64, 32) == 2048);
  CHECK(charts.seam_vertex_count == 0);
  CHECK(charts.charts[0].uv_max == Vec2f(1, 1));
}

TEST_CASE("equal texture coordinates connect charts even where the wedges differ; different ones part them") {
  Mesh mesh = square();
  set_corner_uv(mesh, 1, 0, mesh.wedge(FaceId(1u), 0).uv);
  CHECK(find_charts(mesh).charts.size() == 1);
  CHECK(find_charts(mesh).seam_vertex_count == 0);
  set_corner_uv(mesh, 1, 0, {-0.25f, 0.25f});
  const Charts charts = find_charts(mesh);
  CHECK(charts.charts.size() == 2);
  CHECK(charts.of_face == std::vector<std::uint32_t>{0, 1});
  CHECK(charts.split_vertex_count == 1);
  CHECK(charts.seam_edge_count == 1);
  CHECK(charts.seam_vertex_count == 2);  // the other end of the cut is on the seam too, with one texture coordinate
}

TEST_CASE("a mirrored chart is legal, a fold is a face against its chart") {
  Mesh mirrored = square();
  for (Wedge& w : mirrored.wedges) w.uv.x = 1 - w.uv.x;
  Charts charts = find_charts(mirrored);
  CHECK(charts.charts[0].sign == -1);
  CHECK(charts.charts[0].folds.empty());

  Mesh folded = square();
  folded.wedges[3].uv = {0.75f, 0.25f};  // across the diagonal
  charts = find_charts(folded);
  CHECK(charts.charts[0].sign == 1);
  CHECK(charts.charts[0].folds == std::vector<FaceId>{FaceId(1u)});
  CHECK(charts.charts[0].area_uv == 0.75);

  Mesh flat = square();
  flat.wedges[3].uv = {0.5f, 0.5f};
  charts = find_charts(flat);
  CHECK(charts.charts[0].folds.empty());
  CHECK(charts.charts[0].degenerate == std::vector<FaceId>{FaceId(1u)});
}

TEST_CASE("a chart without area counts as not mirrored") {
  Mesh mesh = square();
  for (Wedge& w : mesh.wedges) w.uv = {0.5f, 0.5f};
  const Charts charts = find_charts(mesh);
  CHECK(charts.charts[0].sign == 1);
  CHECK(charts.charts[0].degenerate.size() == 2);
}

TEST_CASE("charts refuse texture coordinates that are not finite") {
  Mesh mesh = square();
  mesh.wedges[1].uv.y = std::nanf("");
  CHECK_THROWS_AS((void)find_charts(mesh), InternalError);
}
