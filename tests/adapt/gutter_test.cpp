#include "core/adapt/gutter.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/adapt/adapt_map.h"
#include "core/adapt/chain_index.h"
#include "core/adapt/texel_spans.h"
#include "core/base/error.h"
#include "core/base/rng.h"
#include "core/draw/scene.h"
#include "core/mesh/weld.h"
#include "raster/cpu_renderer.h"
#include "tests/adapt/level_fixture.h"

using namespace etalon;
using namespace etalon::adapt;

namespace {

const ChartBorders& head_borders() {
  static const ChartBorders borders(test::head().mesh);
  return borders;
}

Image triangle_ids(const DrawList& list, int width, int height) {
  Frame frame{.width = width, .height = height, .guard = 64, .state = {}, .targets = {{TargetContent::triangle_id, kR32ui, {}}}};
  frame.state.depth_test = false;
  raster::CpuRenderer renderer;
  return renderer.render(list, frame).front();
}

// The level's faces as the rasterizer draws them in texture space.
Image drawn_level(progressive::ProgressiveMesh& mesh, std::size_t level, int width, int height) {
  mesh.go_to(level);
  Frame frame{.width = width, .height = height, .guard = 64, .state = {}, .targets = {}};
  return triangle_ids(make_uv_scene(mesh.mesh(), {Material{}}, frame), width, height);
}

std::size_t differing(const Gutter& gutter, const Image& drawn) {
  std::size_t count = 0;
  for (int y = 0; y < drawn.height(); ++y)
    for (int x = 0; x < drawn.width(); ++x) count += gutter.in_chart(x, y) != (*drawn.channels<std::uint32_t>(x, y) != kNoTriangle) ? 1 : 0;
  return count;
}

// How many texels the plan of one split has, the slow way, by drawing the level after it and its cells: those whose nearest texels in charts
// are all written, and those of which some are (which one counts depends on the chart).
struct SlowPlan {
  std::size_t all = 0, some = 0;
};
SlowPlan planned_by_drawing(std::size_t split, int size) {
  const AdaptSequence& sequence = test::head().sequence;
  const Image level = drawn_level(test::head().mesh, split, size, size);
  SlowPlan plan;
  for (const ChartCells& chart : sequence.split(split)) {
    if (chart.cells.cells.empty()) continue;
    DrawList list;
    for (const CellNode& node : chart.cells.nodes)
      list.vertices.push_back(
          {.x = snap(static_cast<double>(node.after.x) * size, {}), .y = snap(static_cast<double>(node.after.y) * size, {})});
    for (const auto& cell : chart.cells.cells) list.triangles.push_back({cell[0], cell[1], cell[2]});
    list.draws = {{.triangle_count = static_cast<std::uint32_t>(list.triangles.size())}};
    const Image cells = triangle_ids(list, size, size);
    const auto has = [&](const Image& image, int x, int y) {
      return x >= 0 && y >= 0 && x < size && y < size && *image.channels<std::uint32_t>(x, y) != kNoTriangle;
    };
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        if (has(level, x, y) || has(cells, x, y)) continue;
        int nearest = 100;
        for (int j = -kGutterTexels; j <= kGutterTexels; ++j)
          for (int i = -kGutterTexels; i <= kGutterTexels; ++i)
            if (has(level, x + i, y + j)) nearest = std::min(nearest, i * i + j * j);
        bool some = false, all = nearest < 100;
        for (int j = -kGutterTexels; j <= kGutterTexels; ++j)
          for (int i = -kGutterTexels; i <= kGutterTexels; ++i)
            if (i * i + j * j == nearest && has(level, x + i, y + j)) some |= has(cells, x + i, y + j), all &= has(cells, x + i, y + j);
        plan.all += all ? 1 : 0, plan.some += some ? 1 : 0;
      }
  }
  return plan;
}

// Errors, in texels, of plain linear lookups in the map at points of charts whose four texels are not all in charts.
std::vector<double> border_errors(const Image& map, const Gutter& gutter, std::size_t level) {
  test::ModelLevels& head = test::head();
  const ChainIndex chain(head.sequence, level, head.sequence.size());
  const int size = map.width();
  std::vector<double> errors;
  Rng rng(3);
  head.mesh.go_to(level);
  const Mesh mesh = head.mesh.mesh();
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    for (int n = 0; n < 400; ++n) {
      double v = rng.unit(), w = rng.unit();
      if (v + w > 1) v = 1 - v, w = 1 - w;
      const Vec2d a(mesh.wedge(FaceId(f), 0).uv), b(mesh.wedge(FaceId(f), 1).uv), c(mesh.wedge(FaceId(f), 2).uv);
      const Vec2d p = a + v * (b - a) + w * (c - a);
      const double x = p.x * size - 0.5, y = p.y * size - 0.5;
      const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
      if (x0 < 0 || y0 < 0 || x0 + 1 >= size || y0 + 1 >= size) continue;
      const int in = gutter.in_chart(x0, y0) + gutter.in_chart(x0 + 1, y0) + gutter.in_chart(x0, y0 + 1) + gutter.in_chart(x0 + 1, y0 + 1);
      if (in == 0 || in == 4) continue;
      const double s = x - x0, t = y - y0;
      const Vec2d found = (1 - t) * ((1 - s) * map_coordinate(map, x0, y0) + s * map_coordinate(map, x0 + 1, y0)) +
                          t * ((1 - s) * map_coordinate(map, x0, y0 + 1) + s * map_coordinate(map, x0 + 1, y0 + 1));
      const Vec2d d = found - chain.follow(p);
      errors.push_back(std::sqrt(d.x * d.x + d.y * d.y) * size);
    }
  std::sort(errors.begin(), errors.end());
  return errors;
}

}  // namespace

TEST_CASE("texel spans: what the rasterizer covers, on and off the grid's ties") {
  Rng rng(1);
  constexpr int kWidth = 37, kHeight = 29;
  for (int n = 0; n < 3000; ++n) {
    std::array<GridPoint, 3> triangle;
    for (GridPoint& p : triangle) {
      const int step = n % 3 == 0 ? 128 : 1;  // every third on texel centres and corners
      const auto along = [&](int size) {
        return static_cast<std::int64_t>(rng.below(static_cast<std::uint32_t>((size + 8) * 256 / step))) * step - 1024;
      };
      p.x = along(kWidth), p.y = along(kHeight);
    }
    DrawList list;
    for (const GridPoint& p : triangle) list.vertices.push_back({.x = static_cast<std::int32_t>(p.x), .y = static_cast<std::int32_t>(p.y)});
    list.triangles = {{0, 1, 2}};
    list.draws = {{.triangle_count = 1}};
    const Image ids = triangle_ids(list, kWidth, kHeight);
    Image spans(kWidth, kHeight, kR32ui);
    for (int i = 0; i < kWidth * kHeight; ++i) spans.channels<std::uint32_t>(0, 0)[i] = kNoTriangle;
    for_texel_spans(triangle, kWidth, kHeight, [&](int y, int begin, int end) {
      for (int x = begin; x < end; ++x) *spans.channels<std::uint32_t>(x, y) = 0;
    });
    REQUIRE(spans == ids);
  }
}

TEST_CASE("texel spans: coordinates come to the grid as the renderers' do") {
  Rng rng(2);
  for (int n = 0; n < 2000; ++n) {
    // Every second lies half way between two places.
    const float u = n % 2 == 0 ? rng.uniform(-0.1f, 1.1f) : (static_cast<float>(rng.below(300'000)) + 0.5f) / 262'144;
    CHECK(on_grid({u, u}, 1024, 300).x == snap(static_cast<double>(u) * 1024, {}));
    CHECK(on_grid({u, u}, 1024, 300).y == snap(static_cast<double>(u) * 300, {}));
  }
}

TEST_CASE("gutter: the charts of every level are what the rasterizer draws of it, down and up again") {
  const AdaptSequence& sequence = test::head().sequence;
  const std::size_t fine = sequence.size();
  Gutter gutter(head_borders(), 300, 200);
  CHECK(differing(gutter, drawn_level(test::head().mesh, fine, 300, 200)) == 0);
  const Image at_fine = drawn_level(test::head().mesh, fine, 300, 200), at_base = drawn_level(test::head().mesh, 0, 300, 200);
  CHECK(differing(gutter, at_base) > 0);  // borders do move
  for (const std::size_t level : {fine - 500, fine / 2, std::size_t{17}, std::size_t{0}, fine / 3, fine}) {
    (void)gutter.go_to(sequence, level);
    CAPTURE(level);
    CHECK(gutter.level() == level);
    CHECK(differing(gutter, drawn_level(test::head().mesh, level, 300, 200)) == 0);
  }
}

TEST_CASE("gutter: the charts of every level of full-edge collapses, which move border vertices") {
  simplify::SimplifyOptions options;
  options.metric = simplify::MetricName::qem5;
  options.collapse = simplify::CollapseKind::full;
  options.target_faces = 499;
  progressive::ProgressiveMesh mesh(progressive::make_progressive(welded_by_position(test::head().model.mesh), options).data);
  const ChartBorders borders(mesh);
  Gutter gutter(borders, 300, 200);
  const std::size_t fine = mesh.split_count();
  for (const std::size_t level : {fine, fine - 500, fine / 2, std::size_t{17}, std::size_t{0}, fine / 3, fine}) {
    gutter.follow_borders(level);
    CAPTURE(level);
    CHECK(differing(gutter, drawn_level(mesh, level, 300, 200)) == 0);
  }
}

TEST_CASE("gutter: the texels of a plan are those whose nearest texel in a chart is drawn") {
  constexpr int kSize = 160;
  const AdaptSequence& sequence = test::head().sequence;
  Gutter gutter(head_borders(), kSize, kSize);
  (void)gutter.go_to(sequence, 60);
  const GutterPlan plan = gutter.go_to(sequence, 0);
  std::size_t texels = 0;
  for (std::size_t split = 0; split < 60; ++split) {
    CAPTURE(split);
    const std::size_t planned = plan.of_split(split).size();
    const SlowPlan slow = planned_by_drawing(split, kSize);
    CHECK(planned >= slow.all);
    CHECK(planned <= slow.some + plan.uncovered);
    texels += planned;
  }
  CHECK(texels > 500);
}

TEST_CASE("gutter: lookups at borders are as good as the chain; stale texels spoil them") {
  test::ModelLevels& head = test::head();
  raster::CpuRenderer renderer;
  const std::size_t fine = head.sequence.size();
  Image with = identity_map(512, 512), without = with;
  Gutter gutter(head_borders(), 512, 512);
  const AdaptCounts counts = adapt_map(renderer, head.sequence, fine, 0, with, {.gutter = &gutter});
  (void)adapt_map(renderer, head.sequence, fine, 0, without);
  const std::vector<double> good = border_errors(with, gutter, 0), stale = border_errors(without, gutter, 0);
  const auto at = [](const std::vector<double>& errors, std::size_t percent) { return errors[errors.size() * percent / 100]; };
  MESSAGE("border lookups: median " << at(stale, 50) << " without, " << at(good, 50) << " with a gutter; 90 % " << at(stale, 90) << " and "
                                    << at(good, 90) << "; 99 % " << at(stale, 99) << " and " << at(good, 99) << "; texels " << counts.gutter
                                    << ", uncovered " << counts.uncovered << ", doubled " << counts.doubled);
  CHECK(good.size() > 1000);
  CHECK(at(good, 50) < 0.05);
  CHECK(at(stale, 50) > 0.1);
  CHECK(10 * at(good, 90) < at(stale, 90));
  const Gutter::Size size = gutter.size();
  CHECK(size.texels > 1000);
  CHECK(size.contested < size.texels);
  // And back.
  (void)adapt_map(renderer, head.sequence, 0, fine, with, {.gutter = &gutter});
  CHECK(at(border_errors(with, gutter, fine), 50) < 0.1);
}

TEST_CASE("gutter: packed is one by one, byte for byte, down and up, with seams") {
  test::ModelLevels& head = test::head();
  raster::CpuRenderer renderer;
  const std::size_t fine = head.sequence.size(), coarse = fine - 250;
  Image packed = identity_map(200, 200), single = packed;
  Gutter of_packed(head_borders(), 200, 200), of_single = of_packed;
  (void)adapt_map(renderer, head.sequence, fine, coarse, packed, {.gutter = &of_packed});
  for (std::size_t n = fine; n-- > coarse;) (void)adapt_map(renderer, head.sequence, n + 1, n, single, {.gutter = &of_single});
  CHECK(packed == single);
  (void)adapt_map(renderer, head.sequence, coarse, fine, packed, {.gutter = &of_packed});
  for (std::size_t n = coarse; n < fine; ++n) (void)adapt_map(renderer, head.sequence, n, n + 1, single, {.gutter = &of_single});
  CHECK(packed == single);
}

TEST_CASE("gutter: another size, level or mesh is a mistake of the caller") {
  test::ModelLevels& head = test::head();
  raster::CpuRenderer renderer;
  Image map = identity_map(64, 64);
  Gutter other_size(head_borders(), 64, 65), gutter(head_borders(), 64, 64);
  CHECK_THROWS_AS((void)adapt_map(renderer, head.sequence, head.sequence.size(), 0, map, {.gutter = &other_size}), InternalError);
  CHECK_THROWS_AS((void)adapt_map(renderer, head.sequence, 5, 0, map, {.gutter = &gutter}), InternalError);
  CHECK_THROWS_AS((void)gutter.go_to(test::swirl().sequence, 0), InternalError);
  CHECK_THROWS_AS((void)gutter.go_to(head.sequence, head.sequence.size() + 1), InternalError);
}
