// Patterns of unexplained texels, planted, and none where there is none.
#include "validation/diff/defect_patterns.h"

#include <doctest/doctest.h>

#include "core/base/rng.h"
#include "raster/cpu_renderer.h"
#include "tests/validation/scenes.h"
#include "validation/diff/worst_unexplained.h"
#include "validation/texel_explainer.h"

namespace etalon::validation {
namespace {

constexpr int kSize = 80;

struct Case {
  DrawList list = test::quad(kSize, kSize, {0, 0}, {1, 1}, test::busy_texture(120, 120));
  Frame frame = test::frame_of(kSize, kSize, {{TargetContent::color, kRgba8}});
  raster::CpuRenderer cpu;
  Image golden, candidate, classes;

  void draw() {
    golden = cpu.render(list, frame).front();
    candidate = golden;
    classes = Image(kSize, kSize, {ChannelType::unorm8, 1});
  }
  void make_wrong(int x, int y) {
    for (int c = 0; c < 3; ++c) candidate.channels<std::uint8_t>(x, y)[c] ^= static_cast<std::uint8_t>(1 + (7 * x + 3 * y + c) % 200);
    *classes.channels<std::uint8_t>(x, y) = static_cast<std::uint8_t>(TexelClass::unexplained);
  }
  template <class IsWrong>
  std::vector<std::string> patterns(IsWrong&& is_wrong) {
    draw();
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        if (is_wrong(x, y)) make_wrong(x, y);
    return defect_patterns(list, frame, classes, golden, candidate, cpu);
  }
};

TEST_CASE("patterns: a rectangle of an image") {
  Case c;
  // Texel (x, y) of the frame looks up texel (1.5x + 0.75, 1.5y + 0.75); the box is widened by one for what a filter carries across.
  const auto told = c.patterns([](int x, int y) { return x >= 10 && x < 30 && y >= 40 && y < 70; });
  REQUIRE(told.size() == 1);
  CHECK(told[0].find("they lie in x 15 to 44, y 60 to 104 of image 0 (85.2 % of the texels there, 0 % of the others)") == 0);
}

TEST_CASE("patterns: one image of two") {
  Case c;
  c.list = test::list_of({test::at(0, 0, {0, 0}), test::at(kSize, 0, {1, 0}), test::at(0, kSize, {0, 1}), test::at(kSize, 0, {1, 0}),
                          test::at(kSize, kSize, {1, 1}), test::at(0, kSize, {0, 1})},
                         {.shading = Shading::texture, .texture = 0}, {test::busy_texture(16, 16), test::busy_texture(32, 32)});
  c.list.draws[0].triangle_count = 1;
  c.list.draws.push_back({.first_triangle = 1, .triangle_count = 1, .shading = Shading::texture, .texture = 1});
  const auto told = c.patterns([](int x, int y) { return x + y >= kSize; });
  REQUIRE_FALSE(told.empty());
  CHECK(told[0].find("they show image 1 (") == 0);
  CHECK(told[0].find("the other images are right") != std::string::npos);
}

TEST_CASE("patterns: the only image, all over") {
  Case c;
  const auto told = c.patterns([](int x, int y) { return (x + 3 * y) % 8 != 0; });
  REQUIRE(told.size() == 1);
  CHECK(told[0].find("they lie all over what shows image 0 (87.5 % of its texels): other content throughout, as of a stale texture") == 0);
  CHECK(c.patterns([](int x, int y) { return (x + y) % 2 == 0; }).empty());  // half of them: no
}

TEST_CASE("patterns: one size of the footprint") {
  Case c;
  // The lower half is magnified, the upper one minified; both show all of the image.
  const auto strip = [](double y0, double y1, float v1) {
    return std::vector<RasterVertex>{test::at(0, y0, {0, 0}), test::at(kSize, y0, {1, 0}),  test::at(kSize, y1, {1, v1}),
                                     test::at(0, y0, {0, 0}), test::at(kSize, y1, {1, v1}), test::at(0, y1, {0, v1})};
  };
  std::vector<RasterVertex> corners = strip(0, 40, 0.25f);
  for (const RasterVertex& v : strip(40, kSize, 8.13f)) corners.push_back(v);
  c.list = test::list_of(corners, {.shading = Shading::texture, .texture = 0, .sampler = {Filter::nearest, Wrap::repeat, Wrap::repeat}},
                         {test::busy_texture(40, 40)});
  const auto told = c.patterns([](int, int y) { return y >= 40; });
  REQUIRE_FALSE(told.empty());
  CHECK(told[0].find("they lie where 8.13 to 8.13 texels of image 0 fall on one of the frame") == 0);
}

TEST_CASE("patterns: a part of the frame, where the colours come from vertices") {
  Case c;
  c.list = test::list_of(
      {test::at(0, 0), test::at(kSize, 0), test::at(kSize, kSize), test::at(0, 0), test::at(kSize, kSize), test::at(0, kSize)});
  const auto told = c.patterns([](int x, int y) { return x >= 8 && x < 24 && y >= 16 && y < 32; });
  REQUIRE(told.size() == 1);
  CHECK(told[0].find("they lie in x 8 to 23, y 16 to 31 of the frame") == 0);
}

TEST_CASE("patterns: colours that are a function of the right ones") {
  Case c;
  c.draw();
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      for (int k = 0; k < 3; ++k) {
        std::uint8_t& value = c.candidate.channels<std::uint8_t>(x, y)[k];
        value = static_cast<std::uint8_t>(value / 2 + 20);
      }
      *c.classes.channels<std::uint8_t>(x, y) = static_cast<std::uint8_t>(TexelClass::unexplained);
    }
  const auto told = defect_patterns(c.list, c.frame, c.classes, c.golden, c.candidate, c.cpu);
  REQUIRE_FALSE(told.empty());
  CHECK(told.back().find("their colours are a function of the right ones") == 0);
}

TEST_CASE("patterns: chance has none, and a handful of texels either") {
  Case c;
  Rng rng(3);
  std::vector<bool> wrong(kSize * kSize);
  for (auto&& bit : wrong) bit = rng.between(0, 9) == 0;
  CHECK(c.patterns([&](int x, int y) { return wrong[static_cast<std::size_t>(y * kSize + x)]; }).empty());
  CHECK(c.patterns([](int x, int y) { return x < 3 && y < 5; }).empty());
}

TEST_CASE("worst unexplained: the largest differences, apart from each other") {
  Case c;
  c.draw();
  const auto differ_by = [&](int x, int y, int step) {
    std::uint8_t& value = c.candidate.channels<std::uint8_t>(x, y)[1];
    value = static_cast<std::uint8_t>(value >= 128 ? value - step : value + step);
    *c.classes.channels<std::uint8_t>(x, y) = static_cast<std::uint8_t>(TexelClass::unexplained);
  };
  differ_by(10, 10, 100), differ_by(12, 11, 99), differ_by(60, 20, 50), differ_by(30, 70, 120);
  DiffResult diff;
  diff.class_image = c.classes;
  DrawnPair pair;
  pair.cpu = {c.golden}, pair.gl = {c.candidate};
  const auto worst = worst_unexplained(diff, pair, c.list, c.frame, contract_model(), 3);
  REQUIRE(worst.size() == 3);
  CHECK(worst[0].x == 30);
  CHECK(worst[1].x == 10);
  CHECK(worst[2].x == 60);
  CHECK(worst[0].verdict.texel_class == TexelClass::unexplained);
  CHECK(worst_unexplained(diff, pair, c.list, c.frame, contract_model(), 1).size() == 1);
}

}  // namespace
}  // namespace etalon::validation
