// Figures 3 and 4 of the paper: what they show, asked of the program.
#include "validation/studies/kim_drawings.h"

#include <doctest/doctest.h>

#include <cmath>

#include "raster/cpu_renderer.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

constexpr Vec4f kBlack{0, 0, 0, 1}, kRed{1, 0, 0, 1}, kWhite{1, 1, 1, 1}, kGrey{0.25f, 0.25f, 0.25f, 1};

}  // namespace

TEST_CASE("figure 3: two vertices that differ from their neighbours by different amounts are equally important") {
  // ‖c0 − ci‖ is √3 in (a) and 1 in (b); divided by the largest, both sum to 6.
  const double a = visual_importance(color_fan({kWhite, kBlack, kBlack, kBlack, kBlack, kBlack, kBlack}), 0);
  const double b = visual_importance(color_fan({kRed, kBlack, kBlack, kBlack, kBlack, kBlack, kBlack}), 0);
  CHECK(a == 6);
  CHECK(b == a);
  CHECK(visual_importance(color_fan({kRed, kRed, kRed, kRed, kRed, kRed, kRed}), 0) == 0);
  // Grey is a quarter as far from black as white is: one white neighbour makes the five grey ones count a quarter each.
  CHECK(visual_importance(color_fan({kBlack, kWhite, kGrey, kGrey, kGrey, kGrey, kGrey}), 0) == 1 + 5 * 0.25);
  const std::string svg = importance_drawing();
  CHECK(svg.find("I(v0) = 6") != svg.rfind("I(v0) = 6"));  // (a) and (b)
  CHECK(svg.find("I(v0) = 0") != std::string::npos);
}

TEST_CASE("figure 4: a half-edge collapse changes colours on the faces of v0 and nowhere else") {
  const CollapsePatch patch = collapse_patch();
  std::size_t at_v0 = 0;
  for (std::uint32_t f = 0; f < patch.mesh.face_count(); ++f) {
    bool incident = false;
    for (int k = 0; k < 3; ++k) incident = incident || patch.mesh.vertex(FaceId(f), k).index == patch.v0;
    CHECK(patch.changed[f] == incident);
    at_v0 += incident;
  }
  CHECK(at_v0 == 6);
  CHECK(patch.after.size() == patch.mesh.face_count() - 2);

  // The same in pixels: both meshes drawn from above; outside the hexagon around v0 no texel differs, inside some do.
  Mesh after = patch.mesh;
  after.faces.clear();
  for (const auto& f : patch.after) after.faces.push_back({WedgeId(f[0]), WedgeId(f[1]), WedgeId(f[2])});
  raster::CpuRenderer exact;
  constexpr int kSize = 256;
  const VertexColorView view{{.eye = {3, 1.75, 8}, .target = {3, 1.75, 0}, .tan_half_fov_y = 0.5}, kSize, kSize};
  const Image a = draw_vertex_colors(exact, patch.mesh, view), b = draw_vertex_colors(exact, after, view);
  std::size_t inside = 0;
  const Vec3f center = patch.mesh.positions[patch.v0];
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const auto *p = a.channels<std::uint8_t>(x, y), *q = b.channels<std::uint8_t>(x, y);
      if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2]) continue;
      ++inside;
      // The plane z = 0 is 8 units away: 8 units across the frame.
      const double px = 3 + 8 * ((x + 0.5) / kSize - 0.5) - center.x, py = 1.75 + 8 * ((y + 0.5) / kSize - 0.5) - center.y;
      CHECK(px * px + py * py < 1.01);  // the hexagon's corners are at distance 1
    }
  CHECK(inside > 500);  // of 2.6 · (256/8)² = 2660 texels
  CHECK(collapse_drawing().find("after v0") != std::string::npos);
}

TEST_CASE("the curves: nothing without a sweep, one panel a subject") {
  CHECK(sweep_drawing({}).empty());
  KimSubjectResult subject;
  subject.name = "thing";
  for (const KimMethod method : kKimMethods) {
    KimOutcome outcome;
    outcome.method = method;
    outcome.mean = outcome.rms = outcome.image_rms = 2;
    subject.outcomes.push_back(outcome);
  }
  CHECK(sweep_drawing({subject}).empty());
  subject.sweep = {{1e-6, 1, 2, 3}, {1e-4, 2, 2, 2}, {1e-2, 4, 40, 2}};
  const std::string svg = sweep_drawing({subject});
  CHECK(svg.find("thing: kim / qem6") != std::string::npos);
  CHECK(svg.find("nan") == std::string::npos);
  CHECK(ratio_drawing({subject}).find("the paper") != std::string::npos);
}
