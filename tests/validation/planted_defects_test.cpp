// Defects planted into what llvmpipe draws: each must be caught, and named. The oracle draws the sound list on the CPU.
#include <doctest/doctest.h>

#include <bit>
#include <cstring>

#include "core/base/rng.h"
#include "raster/cpu_renderer.h"
#include "tests/validation/llvmpipe.h"
#include "tests/validation/scenes.h"
#include "validation/diagnosis.h"

namespace etalon::validation {
namespace {

using test::at;
using test::llvmpipe_or_skip;

constexpr int kSize = 200;
const TargetSpec kId{TargetContent::triangle_id, kR32ui};

struct Case {
  DrawList list;
  Frame frame;  // of the oracle
  std::vector<Image> golden, candidate;
  DiffResult diff;

  void compare() { diff = diff_images(list, frame, llvmpipe_model(), golden, candidate); }
  [[nodiscard]] std::vector<Hypothesis> named(const DiagnosisOptions& options = {}) const {
    return diagnose(list, frame, llvmpipe_model(), golden, candidate, diff, options);
  }
  [[nodiscard]] std::uint64_t unexplained() const { return diff.counts[TexelClass::unexplained]; }
  [[nodiscard]] std::uint64_t unexplained_by(Cause cause) const { return diff.unexplained_by[static_cast<std::size_t>(cause)]; }
};

// A rotated view of a texture over a fan of triangles: no sample is a tie by construction.
DrawList rotated_fan(std::shared_ptr<const Image> texture, Sampler sampler) {
  const Vec2f n(static_cast<float>(texture->width()), static_cast<float>(texture->height()));
  std::vector<RasterVertex> corners;
  const auto corner = [&](double x, double y) {
    const auto u = static_cast<float>(0.83 * x - 0.41 * y + 40.3), v = static_cast<float>(0.37 * x + 0.79 * y - 11.7);
    return at(x, y, {u / n.x, v / n.y}, {static_cast<float>(x / kSize), static_cast<float>(y / kSize), 0.5f, 1});
  };
  const double ring[][2] = {{3, 7}, {110, -20}, {197, 30}, {188, 190}, {90, 205}, {11, 160}, {3, 7}};
  for (int i = 0; i < 6; ++i) {
    corners.push_back(corner(101.25, 96.5));
    corners.push_back(corner(ring[i][0], ring[i][1]));
    corners.push_back(corner(ring[i + 1][0], ring[i + 1][1]));
  }
  return test::list_of(corners, {.shading = Shading::texture, .texture = 0, .sampler = sampler}, {std::move(texture)});
}

Case sound_case(gpu::GlRenderer& gl, std::vector<TargetSpec> targets, Sampler sampler = {Filter::nearest, Wrap::repeat, Wrap::repeat}) {
  Case c;
  c.list = rotated_fan(test::busy_texture(64, 48), sampler);
  c.frame = test::frame_of(kSize, kSize, std::move(targets), gl.supported_state({}));
  raster::CpuRenderer cpu;
  c.golden = cpu.render(c.list, c.frame);
  c.candidate = gl.render(c.list, c.frame);
  return c;
}

DrawList shifted(const DrawList& list, Vec2f texels) {
  DrawList out = list;
  const Image& texture = *list.images[0];
  for (RasterVertex& v : out.vertices) v.uv += texels / Vec2f(static_cast<float>(texture.width()), static_cast<float>(texture.height()));
  return out;
}

TEST_CASE("without a defect nothing is unexplained, and there is nothing to name") {
  gpu::GlRenderer* gl = llvmpipe_or_skip("planted: none");
  if (gl == nullptr) return;
  for (const ChannelType type : {ChannelType::unorm8, ChannelType::unorm16, ChannelType::half, ChannelType::float32}) {
    Case c = sound_case(*gl, {{TargetContent::color, {type, 4}}, kId});
    c.compare();
    CHECK(c.unexplained() == 0);
    CHECK(c.named().empty());
  }
}

TEST_CASE("a flipped fill rule is a coverage error and named") {
  gpu::GlRenderer* gl = llvmpipe_or_skip("planted: fill rule");
  if (gl == nullptr) return;
  for (const bool with_ids : {true, false}) {
    CAPTURE(with_ids);
    // Edges through sample centres: a lattice of half texels. Declared is the rule opposite to the device's.
    std::vector<RasterVertex> corners;
    Rng rng(4);
    for (int t = 0; t < 300; ++t) {
      for (int k = 0; k < 3; ++k) {
        corners.push_back(at(static_cast<double>(rng.between(0, kSize)) + 0.5, static_cast<double>(rng.between(0, kSize)) + 0.5, {},
                             {static_cast<float>(rng.unit()), static_cast<float>(rng.unit()), 1, 1}, static_cast<float>(rng.unit())));
      }
    }
    Case c;
    c.list = test::list_of(corners);
    c.frame = test::frame_of(kSize, kSize, {{TargetContent::color, kRgba8}}, gl->supported_state({}));
    if (with_ids) c.frame.targets.push_back(kId);
    c.candidate = gl->render(c.list, c.frame);
    REQUIRE(c.frame.state.fill_rule == FillRule::left_ymin);
    c.frame.state.fill_rule = FillRule::right_ymax;
    raster::CpuRenderer cpu;
    c.golden = cpu.render(c.list, c.frame);
    c.compare();
    CHECK(c.unexplained() > 50);
    CHECK(c.unexplained_by(Cause::coverage) == c.unexplained());
    const auto hypotheses = c.named();
    REQUIRE_FALSE(hypotheses.empty());
    CHECK(hypotheses[0].name == "fill rule left_ymin");
    CHECK(hypotheses[0].explained_share == 1);
  }
}

TEST_CASE("half-texel shifts are wrong texel choices and named with their direction") {
  gpu::GlRenderer* gl = llvmpipe_or_skip("planted: half-texel shift");
  if (gl == nullptr) return;
  const struct {
    Vec2f texels;
    const char* name;
  } shifts[] = {{{0.5f, 0}, "texture coordinate shifted by +1/2 texel in u"},
                {{-0.5f, 0}, "texture coordinate shifted by -1/2 texel in u"},
                {{0, 0.5f}, "texture coordinate shifted by +1/2 texel in v"},
                {{0, -0.5f}, "texture coordinate shifted by -1/2 texel in v"},
                {{0.5f, 0.5f}, "texture coordinate shifted by +1/2 texel in u and v"},
                {{-0.5f, -0.5f}, "texture coordinate shifted by -1/2 texel in u and v"}};
  for (const auto& shift : shifts) {
    CAPTURE(shift.name);
    Case c = sound_case(*gl, {{TargetContent::color, kRgba8}, kId});
    c.candidate = gl->render(shifted(c.list, shift.texels), c.frame);
    c.compare();
    CHECK(c.unexplained() > 10000);
    CHECK(c.unexplained_by(Cause::texel_choice) > 0.99 * static_cast<double>(c.unexplained()));
    const auto hypotheses = c.named();
    REQUIRE_FALSE(hypotheses.empty());
    CHECK(hypotheses[0].name == shift.name);
    CHECK(hypotheses[0].explained_share > 0.999);
  }
}

TEST_CASE("a flipped v, a wrong wrap and a wrong filter are named") {
  gpu::GlRenderer* gl = llvmpipe_or_skip("planted: sampler state");
  if (gl == nullptr) return;
  const auto name_of = [&](const char* what, auto&& change) {
    CAPTURE(what);
    Case c = sound_case(*gl, {{TargetContent::color, kRgba8}, kId});
    DrawList wrong = c.list;
    change(wrong);
    c.candidate = gl->render(wrong, c.frame);
    c.compare();
    CHECK(c.unexplained() > 1000);
    const auto hypotheses = c.named();
    REQUIRE_FALSE(hypotheses.empty());
    CHECK(hypotheses[0].name == what);
    CHECK(hypotheses[0].explained_share > 0.99);
  };
  name_of("v flipped", [](DrawList& l) {
    for (RasterVertex& v : l.vertices) v.uv.y = 1 - v.uv.y;
  });
  name_of("wrap clamp", [](DrawList& l) { l.draws[0].sampler = {Filter::nearest, Wrap::clamp, Wrap::clamp}; });
  name_of("wrap mirrored_repeat", [](DrawList& l) {
    l.draws[0].sampler = {Filter::nearest, Wrap::mirrored_repeat, Wrap::mirrored_repeat};
  });
  name_of("filter linear", [](DrawList& l) { l.draws[0].sampler.filter = Filter::linear; });
}

TEST_CASE("one wrong bit in a nearest-filtered unorm target is caught and called isolated") {
  gpu::GlRenderer* gl = llvmpipe_or_skip("planted: one wrong byte");
  if (gl == nullptr) return;
  for (const ChannelType type : {ChannelType::unorm8, ChannelType::unorm16}) {
    for (const bool textured : {true, false}) {
      CAPTURE(to_string(type));
      CAPTURE(textured);
      Case c = sound_case(*gl, {{TargetContent::color, {type, 4}}, kId});
      if (!textured) {
        c.list.draws[0].shading = Shading::vertex_color;
        raster::CpuRenderer cpu;
        c.golden = cpu.render(c.list, c.frame);
        c.candidate = gl->render(c.list, c.frame);
      }
      // A texel where the value lies clearly inside its code, so that no bound reaches the next one: blue is 0.5 in vertex colours.
      const int channel = textured ? 1 : 3;
      c.candidate[0].texel(120, 77)[channel * bytes_per_channel(type)] ^= std::byte{1};
      c.compare();
      CHECK(c.unexplained() == 1);
      CHECK(c.diff.worst[0].x == 120);
      CHECK(c.diff.worst[0].y == 77);
      const auto hypotheses = c.named();
      REQUIRE_FALSE(hypotheses.empty());
      CHECK(hypotheses[0].name == "isolated wrong bytes");
    }
  }
}

TEST_CASE("one wrong unit is caught even where the device filters in 8 bits: its arithmetic is known") {
  gpu::GlRenderer* gl = llvmpipe_or_skip("planted: one unit under 8-bit linear");
  if (gl == nullptr) return;
  Case c = sound_case(*gl, {{TargetContent::color, kRgba8}, kId}, {Filter::linear, Wrap::repeat, Wrap::repeat});
  c.compare();
  REQUIRE(c.unexplained() == 0);
  REQUIRE(c.diff.counts[TexelClass::rounding] > 10000);
  int caught = 0;
  for (int n = 0; n < 100; ++n) {
    const int x = 60 + 7 * (n % 10), y = 60 + 7 * (n / 10);
    const auto value = static_cast<int>(c.candidate[0].texel(x, y)[1]);
    // Towards the oracle's value or beyond it: either is wrong for this device.
    c.candidate[0].texel(x, y)[1] = static_cast<std::byte>(value < 255 ? value + 1 : value - 1);
  }
  c.compare();
  caught = static_cast<int>(c.unexplained());
  // A coordinate within the bound of two positions of 1/256 texel has two legal values; few are that near.
  CHECK(caught >= 85);
  MESSAGE("of 100 wrong units under 8-bit linear filtering, caught: ", caught);
}

TEST_CASE("one wrong last bit of an interpolated float32 is not claimed to be seen") {
  gpu::GlRenderer* gl = llvmpipe_or_skip("planted: one wrong float bit");
  if (gl == nullptr) return;
  Case c = sound_case(*gl, {{TargetContent::coordinate, kRg32f}, kId});
  float& u = c.candidate[0].channels<float>(120, 77)[0];
  // On the side of the oracle's value, so that the defect is not on top of a large legal error.
  const float exact = c.golden[0].channels<float>(120, 77)[0];
  u = std::bit_cast<float>(std::bit_cast<std::uint32_t>(exact) ^ 1u);
  c.compare();
  CHECK(c.unexplained() == 0);
  CHECK(*c.diff.class_image.channels<std::uint8_t>(120, 77) == static_cast<int>(TexelClass::rounding));
}

TEST_CASE("undeclared truncation of halves is caught and named: the device's own, where the oracle was told nearest even") {
  gpu::GlRenderer* gl = llvmpipe_or_skip("planted: half toward zero");
  if (gl == nullptr) return;
  if (gl->device().half_rounding != HalfRounding::toward_zero)
    return test::report_skip("planted: half toward zero", "this device rounds halves to nearest");
  Case c = sound_case(*gl, {{TargetContent::coordinate, {ChannelType::half, 2}}, kId});
  c.frame.state.half_rounding = HalfRounding::nearest_even;
  raster::CpuRenderer cpu;
  c.golden = cpu.render(c.list, c.frame);
  c.compare();
  CHECK(c.unexplained() > 10000);
  const auto hypotheses = c.named();
  REQUIRE_FALSE(hypotheses.empty());
  CHECK(hypotheses[0].name == "half stored toward zero");
  CHECK(hypotheses[0].explained_share == 1);
}

TEST_CASE("truncation in unorm storage is caught and named") {
  gpu::GlRenderer* gl = llvmpipe_or_skip("planted: unorm toward zero");
  if (gl == nullptr) return;
  for (const ChannelType type : {ChannelType::unorm8, ChannelType::unorm16}) {
    CAPTURE(to_string(type));
    Case c = sound_case(*gl, {{TargetContent::color, {type, 4}}, kId});
    c.list.draws[0].shading = Shading::vertex_color;
    raster::CpuRenderer cpu;
    c.golden = cpu.render(c.list, c.frame);
    // The device's own float32 values, truncated as a careless store would.
    Frame wide = c.frame;
    wide.targets[0].format = kRgba32f;
    const auto values = gl->render(c.list, wide);
    c.candidate[1] = values[1];
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        for (int k = 0; k < 4; ++k) {
          const float v = std::clamp(values[0].channels<float>(x, y)[k], 0.0f, 1.0f);
          if (type == ChannelType::unorm8) {
            c.candidate[0].channels<std::uint8_t>(x, y)[k] = static_cast<std::uint8_t>(v * 255);
          } else {
            c.candidate[0].channels<std::uint16_t>(x, y)[k] = static_cast<std::uint16_t>(v * 65535);
          }
        }
      }
    }
    c.compare();
    CHECK(c.unexplained() > 10000);
    CHECK(c.unexplained_by(Cause::value) == c.unexplained());
    const auto hypotheses = c.named();
    REQUIRE_FALSE(hypotheses.empty());
    CHECK(hypotheses[0].name == "unorm stored toward zero");
    CHECK(hypotheses[0].explained_share == 1);
  }
}

TEST_CASE("a missing depth test is an error of depth order") {
  gpu::GlRenderer* gl = llvmpipe_or_skip("planted: depth test");
  if (gl == nullptr) return;
  for (const bool with_ids : {true, false}) {
    CAPTURE(with_ids);
    std::vector<RasterVertex> corners;
    Rng rng(6);
    for (int t = 0; t < 40; ++t) {
      const Vec4f color(static_cast<float>(rng.unit()), static_cast<float>(rng.unit()), static_cast<float>(rng.unit()), 1);
      for (int k = 0; k < 3; ++k) corners.push_back(at(rng.unit() * kSize, rng.unit() * kSize, {}, color, static_cast<float>(rng.unit())));
    }
    Case c;
    c.list = test::list_of(corners);
    c.frame = test::frame_of(kSize, kSize, {{TargetContent::color, kRgba8}}, gl->supported_state({}));
    if (with_ids) c.frame.targets.push_back(kId);
    raster::CpuRenderer cpu;
    c.golden = cpu.render(c.list, c.frame);
    Frame wrong = c.frame;
    wrong.state.depth_test = false;
    c.candidate = gl->render(c.list, wrong);
    c.compare();
    CHECK(c.unexplained() > 5000);
    CHECK(c.unexplained_by(Cause::depth_order) == c.unexplained());
  }
}

TEST_CASE("another sub-texel rounding is named where the scene can be made again") {
  gpu::GlRenderer* gl = llvmpipe_or_skip("planted: snap");
  if (gl == nullptr) return;
  // Positions between the sub-texels: floor and nearest differ for half of them.
  std::vector<Vec2d> positions;
  Rng rng(8);
  for (int t = 0; t < 3000; ++t) {
    const Vec2d middle(rng.unit() * kSize, rng.unit() * kSize);
    for (int k = 0; k < 3; ++k) positions.push_back(middle + Vec2d(rng.unit() * 6, rng.unit() * 6));
  }
  const auto scene = [&](SnapRounding snap) {
    std::vector<RasterVertex> corners;
    for (const Vec2d& p : positions) {
      const auto grid = [&](double x) {
        return snap == SnapRounding::floor || snap == SnapRounding::toward_zero ? std::floor(x * 256) / 256 : std::nearbyint(x * 256) / 256;
      };
      corners.push_back(at(grid(p.x), grid(p.y), {}, {1, 1, 1, 1}));
    }
    return test::list_of(corners);
  };
  Case c;
  c.list = scene(SnapRounding::nearest_even);
  c.frame = test::frame_of(kSize, kSize, {{TargetContent::color, kRgba8}, kId}, gl->supported_state({}));
  raster::CpuRenderer cpu;
  c.golden = cpu.render(c.list, c.frame);
  c.candidate = gl->render(scene(SnapRounding::floor), c.frame);
  c.compare();
  CHECK(c.unexplained() > 20);
  const auto hypotheses = c.named({.scene_with_snap = scene});
  REQUIRE_FALSE(hypotheses.empty());
  CHECK(hypotheses[0].name.substr(0, 19) == "sub-texel rounding ");
  CHECK(hypotheses[0].explained_share == 1);
}

TEST_CASE("a mistake that explains less than half is not named") {
  // The texture is flipped in v over a third of the frame's rows and all other texels are wrong at random: no mistake of a pipeline.
  const Frame frame = test::frame_of(64, 64, {{TargetContent::color, kRgba8}, kId});
  DrawList list =
      test::list_of({at(0, 0, {0, 0}), at(64, 0, {1, 0}), at(0, 64, {0, 1}), at(64, 0, {1, 0}), at(64, 64, {1, 1}), at(0, 64, {0, 1})});
  Image texture(16, 16, kRgba8);
  Rng rng(9);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      for (int k = 0; k < 4; ++k) texture.channels<std::uint8_t>(x, y)[k] = static_cast<std::uint8_t>(rng.between(0, 255));
    }
  }
  list.images = {std::make_shared<const Image>(texture)};
  list.draws[0].shading = Shading::texture;
  list.draws[0].texture = 0;
  list.draws[0].sampler = {Filter::nearest, Wrap::repeat, Wrap::repeat};
  raster::CpuRenderer cpu;
  const auto golden = cpu.render(list, frame);
  DrawList flipped = list;
  for (RasterVertex& v : flipped.vertices) v.uv.y = 1 - v.uv.y;
  const auto named = [&](int flipped_rows) {
    auto candidate = cpu.render(flipped, frame);
    Rng noise(10);
    for (int y = flipped_rows; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        for (int k = 0; k < 4; ++k) candidate[0].channels<std::uint8_t>(x, y)[k] = static_cast<std::uint8_t>(noise.between(0, 255));
      }
    }
    return diagnose(list, frame, llvmpipe_model(), golden, candidate, diff_images(list, frame, llvmpipe_model(), golden, candidate));
  };
  CHECK(named(20).empty());
  REQUIRE_FALSE(named(44).empty());
  CHECK(named(44)[0].name == "v flipped");
}

TEST_CASE("diagnosis needs the class image") {
  const Frame frame = test::frame_of(8, 8, {{TargetContent::color, kRgba8}});
  const DrawList list = test::list_of({at(0, 0), at(8, 0), at(0, 8)});
  raster::CpuRenderer cpu;
  const auto golden = cpu.render(list, frame);
  const DiffResult diff = diff_images(list, frame, llvmpipe_model(), golden, golden, {.keep_class_image = false});
  CHECK_THROWS_AS((void)diagnose(list, frame, llvmpipe_model(), golden, golden, diff), InputError);
}

}  // namespace
}  // namespace etalon::validation
