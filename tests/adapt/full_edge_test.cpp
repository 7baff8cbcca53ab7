// Adaptation through full-edge collapses: the swirl keeps its picture, the chain is its own inverse, charts are followed.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>

#include "core/adapt/adapt_map.h"
#include "core/adapt/gutter.h"
#include "core/draw/scene.h"
#include "core/mesh/exact_orientation.h"
#include "core/procedural/head.h"
#include "core/procedural/swirl.h"
#include "raster/cpu_renderer.h"
#include "tests/adapt/level_fixture.h"
#include "validation/metrics/image_difference.h"

using namespace etalon;
using namespace etalon::adapt;
using simplify::CollapseKind;

TEST_CASE("full-edge: the swirl at 399 faces keeps its picture; the chain comes back to 2^-30 texel") {
  test::ModelLevels s(procedural::make_swirl({.faces = 7688, .texture_size = 512}), 399, CollapseKind::full);
  REQUIRE(s.mesh.data().moves.size() > 2000);
  Image adapted = s.model.texture;
  raster::CpuRenderer renderer;
  (void)adapt_map(renderer, s.sequence, s.sequence.size(), 0, adapted);
  Frame frame{.width = 256, .height = 256, .guard = 0, .state = {}, .targets = {{}}};
  frame.state.depth_test = true;
  const Camera camera = named_view("front", bounding_box(s.model.mesh), 256, 256);
  const auto psnr = [&](const Mesh& mesh, const Image& texture) {
    const auto picture = [&](const Mesh& drawn, const Image& with) {
      const Material material{.texture = std::make_shared<const Image>(with), .sampler = {Filter::linear, Wrap::clamp, Wrap::clamp}};
      return renderer.render(make_scene(drawn, {material}, camera, frame), frame).front();
    };
    return validation::measure_difference(picture(s.model.mesh, s.model.texture), picture(mesh, texture)).psnr_db().value_or(1000);
  };
  s.mesh.go_to(0);
  const Mesh coarse = s.mesh.mesh();
  const double unadapted = psnr(coarse, s.model.texture), by_texture = psnr(coarse, adapted);
  MESSAGE("PSNR against the full model: unadapted " << unadapted << " dB, adapted texture " << by_texture << " dB");
  CHECK(by_texture > unadapted + 3);
  for (int y = 0; y < 512; y += 37)
    for (int x = 0; x < 512; x += 29) {
      const Vec2d p((x + 0.5) / 512, (y + 0.5) / 512),
          q = s.sequence.follow(s.sequence.follow(p, s.sequence.size(), 0), 0, s.sequence.size());
      CHECK(std::hypot(q.x - p.x, q.y - p.y) * 512 <= 0x1p-30);
    }
}

TEST_CASE("full-edge: texels known to be in charts are those that the level's faces cover") {
  test::ModelLevels s(procedural::make_head({.faces = 1200, .texture_size = 64}), 200, CollapseKind::full);
  REQUIRE(s.mesh.data().moves.size() > 200);
  const ChartBorders borders(s.mesh);
  constexpr int kSize = 96;
  Gutter gutter(borders, kSize, kSize);
  for (const std::size_t level : {s.mesh.split_count(), s.mesh.split_count() / 2, std::size_t{0}}) {
    (void)gutter.go_to(s.sequence, level);
    s.mesh.go_to(level);
    std::size_t different = 0, inside = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const Vec2f p{(static_cast<float>(x) + 0.5f) / kSize, (static_cast<float>(y) + 0.5f) / kSize};
        bool covered = false;
        for (std::size_t f = 0; f < s.mesh.face_count() && !covered; ++f) {
          const auto& w = s.mesh.face_wedges(f);
          const Vec2f &a = s.mesh.uv(w[0]), &b = s.mesh.uv(w[1]), &c = s.mesh.uv(w[2]);
          covered = orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0;
        }
        inside += covered ? 1 : 0, different += covered != gutter.in_chart(x, y) ? 1 : 0;
      }
    CAPTURE(level);
    MESSAGE(inside << " texels in charts, " << different << " different");
    CHECK(inside > 1000);
    // There corners are snapped to 1/256 texel, here they are not; no centre is that near to an edge.
    CHECK(different == 0);
  }
}
