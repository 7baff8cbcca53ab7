// The scenes are what their titles say: counts, coverage, ties, halves.
#include <cmath>
#include <cstdint>

#include <doctest/doctest.h>

#include "raster/cpu_renderer.h"
#include "tests/bench/fan_scene.h"
#include "tests/support/skip.h"

using namespace etalon;
using namespace etalon::bench;

namespace {

Image drawn(const BenchScene& scene, TargetSpec target) {
  Frame frame = scene.frame;
  frame.targets = {target};
  raster::CpuRenderer renderer;
  return renderer.render(scene.list, frame).front();
}

/// Twice the signed area in sub-texels².
std::int64_t area2(const BenchScene& scene, std::size_t t) {
  const auto& corner = scene.list.triangles[t];
  const RasterVertex &a = scene.list.vertices[corner[0]], &b = scene.list.vertices[corner[1]], &c = scene.list.vertices[corner[2]];
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

double mean_area_texel(const BenchScene& scene) {
  double sum = 0;
  for (std::size_t t = 0; t < scene.list.triangles.size(); ++t) sum += std::abs(static_cast<double>(area2(scene, t)));
  return sum / 2 / (256.0 * 256.0) / static_cast<double>(scene.list.triangles.size());
}

/// Valid for both renderers, one draw, and nothing outside the frame.
void check_form(const BenchScene& scene) {
  CHECK_NOTHROW(validate(scene.list, scene.frame));
  CHECK(scene.list.draws.size() == 1);
  CHECK(scene.frame.guard == 0);
  CHECK(scene.frame.targets.size() == 1);
}

}  // namespace

TEST_CASE("bench scenes: small triangles are small") {
  const BenchScene scene = small_triangles_scene(20'000);
  check_form(scene);
  CHECK(scene.frame.width == 512);
  CHECK(scene.frame.state.depth_test);
  CHECK(scene.list.triangles.size() == 20'000);
  // Three uniform points in a square of 64 texels: 64·11/144 = 4.89; the mean of 20,000 is within 2 %.
  CHECK(mean_area_texel(scene) == doctest::Approx(64.0 * 11 / 144).epsilon(0.02));
  CHECK(work_of(scene).lookups == 0);
}

TEST_CASE("bench scenes: the head is drawn large, by either filter") {
  for (const Filter filter : {Filter::nearest, Filter::linear}) {
    const BenchScene scene = head_scene(filter);
    check_form(scene);
    CHECK(scene.list.triangles.size() == 7684);
    CHECK(scene.list.images.front()->format() == kRgba8);
    CHECK(scene.list.draws.front().sampler.filter == filter);
    const SceneWork work = work_of(scene);
    CHECK(work.covered_texels > 150'000);
    CHECK(work.covered_texels < 1024 * 1024);
    CHECK(work.lookups == work.covered_texels * (filter == Filter::linear ? 4 : 1));
    CHECK(work.frame_bytes == 4 * 1024 * 1024);
  }
}

TEST_CASE("bench scenes: the real head, where it is") {
  const auto scene = real_head_scene(Filter::nearest);
  if (!scene) return test::report_skip("bench scenes: the real head, where it is", "lee_perry_smith is not in $ETALON_DATA");
  check_form(*scene);
  CHECK(scene->list.triangles.size() == 17'684);
  CHECK(work_of(*scene).covered_texels > 250'000);
}

TEST_CASE("bench scenes: a screen without warp is its image") {
  const BenchScene scene = full_screen_scene(ScreenWarp::identity);
  check_form(scene);
  CHECK_FALSE(scene.frame.state.depth_test);
  CHECK(drawn(scene, {}) == *scene.list.images.front());
}

TEST_CASE("bench scenes: half a texel makes every texel a tie, the rotation none") {
  const auto ties = [](ScreenWarp warp) {
    const BenchScene scene = full_screen_scene(warp);
    check_form(scene);
    const Image margins = drawn(scene, {TargetContent::margins, kRgba32f});
    std::size_t count = 0;
    for (int y = 0; y < margins.height(); ++y)
      for (int x = 0; x < margins.width(); ++x) {
        const auto* m = margins.channels<float>(x, y);
        count += m[1] == 0 && m[2] == 0 ? 1 : 0;
      }
    return count;
  };
  CHECK(ties(ScreenWarp::half_texel) == 1024 * 1024);
  CHECK(ties(ScreenWarp::rotated) < 1024);
}

TEST_CASE("bench scenes: knot and terrain have as many triangles as asked") {
  const BenchScene knot = knot_scene(200, 40);
  check_form(knot);
  CHECK(knot.list.triangles.size() == 16'000);
  CHECK(knot.list.draws.front().shading == Shading::vertex_color);
  CHECK(work_of(knot).covered_texels > 300'000);
  const BenchScene terrain = terrain_scene(64);
  check_form(terrain);
  CHECK(terrain.list.triangles.size() == 2 * 64 * 64);
  CHECK(work_of(terrain).covered_texels > 300'000);
  // Seen from above, faces that look up are counter-clockwise.
  std::size_t upward = 0;
  for (std::size_t t = 0; t < terrain.list.triangles.size(); ++t) upward += area2(terrain, t) > 0 ? 1 : 0;
  CHECK(upward > terrain.list.triangles.size() * 9 / 10);
}

TEST_CASE("bench scenes: fans are decagons of 105 texels that keep to their half of the maps") {
  const BenchScene scene = fan_scene(1000);
  check_form(scene);
  const DrawList& list = scene.list;
  REQUIRE(list.triangles.size() == 1000 * kFanTriangles);
  CHECK(scene.frame.targets.front().format == kRg32f);
  CHECK(mean_area_texel(scene) * kFanTriangles == doctest::Approx(105).epsilon(0.005));
  for (std::size_t t = 0; t < list.triangles.size(); ++t) {
    REQUIRE(area2(scene, t) > 0);
    const int half = static_cast<int>(t / kFanTriangles % 2);
    for (const std::uint32_t corner : list.triangles[t]) {
      const RasterVertex& v = list.vertices[corner];
      REQUIRE((v.x >= half * 512 * 256 && v.x <= (half + 1) * 512 * 256));
      REQUIRE((v.uv.x >= 0.5f * static_cast<float>(half) && v.uv.x < 0.5f * static_cast<float>(half + 1)));
    }
  }
  // Each visible texel has the number of another texel, near by.
  const Image map = drawn(scene, {TargetContent::color, kRg32f}), ids = drawn(scene, {TargetContent::triangle_id, kR32ui});
  std::size_t covered = 0, moved = 0;
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) {
      if (*ids.channels<std::uint32_t>(x, y) == kNoTriangle) continue;
      ++covered;
      const auto* value = map.channels<float>(x, y);
      const float dx = value[0] * 1024 - 0.5f - static_cast<float>(x), dy = value[1] * 1024 - 0.5f - static_cast<float>(y);
      // The warp is at most 0.7 texel, snapping 1/256, nearest lookup half a texel from the coordinate and half from the centre.
      REQUIRE((std::abs(dx) <= 1 && std::abs(dy) <= 1));
      moved += dx != 0 || dy != 0 ? 1 : 0;
    }
  CHECK(covered > 90'000);
  CHECK(moved > covered / 10);
}

TEST_CASE("bench scenes: each has its own name") {
  const std::vector<SceneEntry> entries = scene_entries();
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) CHECK(entries[i].name != entries[k].name);
}
