#include "core/procedural/swirl.h"

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/mesh/exact_orientation.h"
#include "core/mesh/mesh_validation.h"
#include "tests/procedural/mesh_sha256.h"

using namespace etalon;
using namespace etalon::procedural;

TEST_CASE("the swirl has the paper's size and nothing wrong with it") {
  const Model swirl = make_swirl();
  CHECK(swirl.name == "swirl");
  CHECK(swirl.mesh.vertex_count() == 63 * 63);
  CHECK(swirl.mesh.face_count() == 7688);
  CHECK(swirl.texture.width() == 1024);
  CHECK(swirl.texture.height() == 1024);
  CHECK(swirl.texture.format() == kRgb8);
  const MeshReport report = validate_mesh(swirl.mesh);
  CHECK(report.manifold());
  CHECK(report.oriented());
  CHECK(report.component_count == 1);
  CHECK(report.boundary_loop_count == 1);
  CHECK(report.boundary_edges.count == 4 * 62);
  CHECK(report.degenerate_faces.count == 0);
  CHECK(report.chart_count == 1);
  CHECK(report.negative_uv_faces == 0);
  CHECK(report.degenerate_uv_faces.count == 0);
  CHECK(report.uv_outside.count == 0);
  CHECK(report.uv_overlaps.count == 0);
  CHECK(report.uv_coverage == 1);
}

TEST_CASE("the swirl faces +Z and really swirls") {
  const Model swirl = make_swirl();
  for (std::uint32_t f = 0; f < swirl.mesh.face_count(); ++f) {
    const auto xy = [&](int k) { return Vec2f(swirl.mesh.position(FaceId(f), k).x, swirl.mesh.position(FaceId(f), k).y); };
    REQUIRE(orientation(xy(0), xy(1), xy(2)) == 1);
  }
  // Beside the centre uv has turned by almost 0.4 turns: what lies at +x is looked up at −x.
  const Wedge& beside = swirl.mesh.wedges[31 * 63 + 34];
  CHECK(swirl.mesh.positions[beside.vertex.index].x > 0);
  CHECK(beside.uv.x < 0.5f);
}

TEST_CASE("the swirl in other sizes has no folds") {
  for (int n = 1; n <= 120; ++n) {
    CAPTURE(n);
    const Model swirl = make_swirl({.faces = 2 * n * n, .texture_size = 16});
    REQUIRE(swirl.mesh.face_count() == static_cast<std::size_t>(2 * n * n));
    for (std::uint32_t f = 0; f < swirl.mesh.face_count(); ++f)
      REQUIRE(orientation(swirl.mesh.wedge(FaceId(f), 0).uv, swirl.mesh.wedge(FaceId(f), 1).uv, swirl.mesh.wedge(FaceId(f), 2).uv) == 1);
    for (const Wedge& w : swirl.mesh.wedges) REQUIRE((w.uv.x >= 0 && w.uv.x <= 1 && w.uv.y >= 0 && w.uv.y <= 1));
  }
  CHECK(make_swirl({.faces = 2, .texture_size = 16}).mesh.face_count() == 2);
}

TEST_CASE("the swirl's bytes") {
  const Model swirl = make_swirl();
  CHECK(swirl.texture.sha256() == "58908ee26c82f48f4d8b82a188ebc4ee25f9f41593b5a32743578d90c7a31d06");
  CHECK(test::mesh_sha256(swirl.mesh) == "6b6f9fca52582802a3b10493d3d713ed1f42364894a651aa1148a1ee7d09a3aa");
}

TEST_CASE("the swirl refuses sizes out of range") {
  CHECK_THROWS_WITH_AS((void)make_swirl({.faces = 1}), "swirl: faces: expected 2 to 2000000, got 1", InputError);
  CHECK_THROWS_AS((void)make_swirl({.faces = 2'000'001}), InputError);
  CHECK_THROWS_WITH_AS((void)make_swirl({.texture_size = 15}), "swirl: texture size: expected 16 to 8192, got 15", InputError);
  CHECK_THROWS_AS((void)make_swirl({.texture_size = 8193}), InputError);
}
