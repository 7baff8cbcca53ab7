// The diff's own evaluation against the CPU renderer, of which it shares nothing: coverage, ids, values, depth.
#include "validation/fragments.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "raster/cpu_renderer.h"
#include "tests/validation/random_scene.h"
#include "tests/validation/scenes.h"

namespace etalon::validation {
namespace {

TEST_CASE("coverage, visibility and values agree with the renderer on random scenes, under every fill rule and cull mode") {
  raster::CpuRenderer cpu;
  std::uint64_t covered = 0;
  for (std::uint64_t seed = 0; seed < 44; ++seed) {
    CAPTURE(seed);
    test::RandomScene scene = test::make_random_scene(seed, {}, 96);
    scene.frame.state.fill_rule = static_cast<FillRule>(seed % 4);
    scene.frame.state.cull = static_cast<CullMode>(seed % 3);
    scene.frame.targets = {{TargetContent::triangle_id, kR32ui},
                           {TargetContent::depth, kR32f},
                           {TargetContent::coordinate, kRg32f},
                           {TargetContent::barycentrics, {ChannelType::float32, 3}},
                           {TargetContent::margins, kRgba32f}};
    const auto images = cpu.render(scene.list, scene.frame);
    const TriangleGrid grid(scene.list, scene.frame);
    std::vector<TriangleEvaluator> evaluators;
    for (std::uint32_t t = 0; t < scene.list.triangles.size(); ++t) evaluators.emplace_back(scene.list, t, scene.frame);
    long wrong = 0, missed = 0;
    double worst = 0;
    for (int y = 0; y < scene.frame.height; ++y) {
      for (int x = 0; x < scene.frame.width; ++x) {
        std::uint32_t visible = kNoTriangle;
        float nearest = 1;
        for (auto it = grid.begin(x, y); it != grid.end(x, y); ++it) {
          const TriangleEvaluator& e = evaluators[*it];
          if (!e.covers(x, y)) continue;
          const auto z = static_cast<float>(e.linear(e.sample(x, y), e.z()));
          if (scene.frame.state.depth_test ? z < nearest : true) {
            visible = *it;
            nearest = z;
          }
        }
        for (const TriangleEvaluator& e : evaluators)
          missed += e.covers(x, y) && std::find(grid.begin(x, y), grid.end(x, y), e.id()) == grid.end(x, y);
        const std::uint32_t id = *images[0].channels<std::uint32_t>(x, y);
        wrong += visible != id;
        if (visible != id || id == kNoTriangle) continue;
        ++covered;
        const TriangleEvaluator& e = evaluators[id];
        const Sample s = e.sample(x, y);
        const auto near = [&](float stored, double value, double scale) {
          worst = std::max(worst, std::abs(static_cast<double>(stored) - value) / (0x1p-24 * std::max(scale, std::abs(value)) + 0x1p-150));
        };
        near(*images[1].channels<float>(x, y), e.linear(s, e.z()), 0);
        near(images[2].channels<float>(x, y)[0], e.perspective(s, e.u()), 0x1p-20);
        near(images[2].channels<float>(x, y)[1], e.perspective(s, e.v()), 0x1p-20);
        for (std::size_t k = 0; k < 3; ++k) near(images[3].channels<float>(x, y)[e.order()[k]], s.weight[k], 0);
        near(images[4].channels<float>(x, y)[0], e.edge_margin(s), 0);
      }
    }
    CHECK(wrong == 0);
    CHECK(missed == 0);
    CHECK(worst <= 1.0001);  // one rounding to float32
  }
  CHECK(covered > 50000);
}

TEST_CASE("wide positions: edge values beyond 64 bits stay exact") {
  Frame frame = test::frame_of(4, 4, {});
  frame.guard = 8190;
  frame.state.subtexel_bits = 16;
  DrawList list = test::list_of({test::at(0, 0), test::at(0, 0), test::at(0, 0)});
  const int far = 8190 << 16;
  list.vertices[0].x = -far;
  list.vertices[0].y = -far;
  list.vertices[1].x = far + (4 << 16);
  list.vertices[1].y = far + (4 << 16);
  list.vertices[2].x = far;
  list.vertices[2].y = -far;
  const TriangleEvaluator e(list, 0, frame);
  for (int i = 0; i < 4; ++i) {
    CHECK(e.touches(i, i));  // the diagonal runs through the sample centres
    CHECK(e.covers(i, i) != TriangleEvaluator(list, 0,
                                              [&] {
                                                Frame other = frame;
                                                other.state.fill_rule = FillRule::right_ymax;
                                                return other;
                                              }())
                                .covers(i, i));
  }
  CHECK(e.covers(2, 1));
  CHECK_FALSE(e.covers(1, 2));
}

TEST_CASE("no area, no triangle") {
  const Frame frame = test::frame_of(8, 8, {});
  const DrawList list = test::list_of({test::at(0, 0), test::at(4, 4), test::at(8, 8)});
  const TriangleEvaluator e(list, 0, frame);
  CHECK_FALSE(e.draws());
  CHECK_FALSE(e.covers(2, 2));
  CHECK_FALSE(e.touches(2, 2));
}

}  // namespace
}  // namespace etalon::validation
