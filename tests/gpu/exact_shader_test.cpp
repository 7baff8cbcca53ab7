// The exact shader against the exact rasterizer: the same bytes, wherever coverage is (docs/exact-shader.md). Random scenes in bulk are the
// business of etalon_crosscheck --shader exact; here are the formats, the ties and the edges of the contract's input.
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/math/half.h"
#include "gpu/exact_pipeline.h"
#include "gpu/exact_probe.h"
#include "raster/cpu_renderer.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/support/skip.h"

using namespace etalon;
using namespace etalon::gpu;
using namespace etalon::gpu::test;

namespace {

constexpr std::array<ChannelType, 5> kTypes{ChannelType::unorm8, ChannelType::srgb8, ChannelType::unorm16, ChannelType::half,
                                            ChannelType::float32};

GlRenderer* exact_or_skip(const std::string& test_case) {
  static std::string reason;
  static const std::unique_ptr<GlRenderer> renderer = [] {
    std::unique_ptr<GlRenderer> made;
    try {
      made = std::make_unique<GlRenderer>(ContextOptions{.driver = Driver::llvmpipe}, ShaderMode::exact);
    } catch (const UnavailableError& error) {
      reason = error.what();
    }
    return made;
  }();
  if (renderer == nullptr) etalon::test::report_skip(test_case, reason);
  return renderer.get();
}

// Per target: texels whose bytes differ.
std::vector<std::size_t> differing(const std::vector<Image>& a, const std::vector<Image>& b) {
  std::vector<std::size_t> counts;
  for (std::size_t n = 0; n < a.size(); ++n) counts.push_back(differing_texels(a[n], b[n]));
  return counts;
}

// Draws on both sides and compares; returns the CPU's images.
std::vector<Image> check_identical(Renderer& gl, const DrawList& list, const Frame& frame) {
  raster::CpuRenderer cpu;
  const std::vector<Image> golden = cpu.render(list, frame), drawn = gl.render(list, frame);
  REQUIRE(drawn.size() == golden.size());
  const std::vector<std::size_t> counts = differing(golden, drawn);
  for (std::size_t n = 0; n < counts.size(); ++n) {
    CHECK_MESSAGE(counts[n] == 0, to_string(frame.targets[n].content), " ", to_string(frame.targets[n].format), ": ", counts[n], " texels");
  }
  return golden;
}

std::size_t covered(const Image& ids) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < ids.texel_count(); ++i) count += ids.channels<std::uint32_t>(0, 0)[i] != kNoTriangle ? 1 : 0;
  return count;
}

TargetSpec color_target(ChannelType type, int channels) { return {TargetContent::color, {type, channels}, {0.3f, -0.2f, 1.5f, 0.7f}}; }

// Triangles with random corners, w and attributes; some are slivers, some share an edge with the one before.
DrawList random_list(Rng& rng, const Frame& frame, int count, float attribute_range) {
  DrawList list;
  const auto grid = std::int64_t{1} << frame.state.subtexel_bits;
  const auto position = [&](int extent) {
    return static_cast<std::int32_t>(rng.between(-frame.guard * grid, (extent + frame.guard) * grid));
  };
  for (int t = 0; t < count; ++t) {
    const bool affine = rng.coin(), sliver = rng.below(4) == 0;
    const auto first = static_cast<std::uint32_t>(list.vertices.size());
    for (int k = 0; k < 3; ++k) {
      RasterVertex v;
      v.x = position(frame.width);
      v.y = position(frame.height);
      if (sliver && k == 2) {
        v.x = (list.vertices[first].x + list.vertices[first + 1].x) / 2 + static_cast<std::int32_t>(rng.between(-1, 1));
        v.y = (list.vertices[first].y + list.vertices[first + 1].y) / 2;
      }
      v.z = static_cast<float>(rng.unit());
      v.w = affine ? 1.0f : rng.uniform(0.25f, 4.0f);
      v.uv = {rng.uniform(-2, 2), rng.uniform(-2, 2)};
      for (int c = 0; c < 4; ++c) v.color[c] = rng.uniform(-0.1f, 1) * attribute_range;
      list.vertices.push_back(v);
    }
    list.triangles.push_back({first, first + 1, first + 2});
    if (first > 0 && rng.below(4) == 0) list.triangles.back()[0] = first - 1, list.triangles.back()[1] = first - 2;
  }
  list.draws = {{.triangle_count = static_cast<std::uint32_t>(list.triangles.size())}};
  return list;
}

Image random_texture(Rng& rng, int width, int height, PixelFormat format) {
  Image image = random_image(width, height, format, rng);
  // What random_image() leaves out: zeros of both signs and subnormals.
  for (int n = 0; n < 24; ++n) {
    const int x = static_cast<int>(rng.below(static_cast<std::uint64_t>(width))),
              y = static_cast<int>(rng.below(static_cast<std::uint64_t>(height)));
    const auto c = rng.below(static_cast<std::uint64_t>(format.channels));
    const std::uint64_t sign = rng.below(2), mantissa = rng.below(8) == 0 ? 0 : rng.next();
    if (format.type == ChannelType::half)
      image.channels<std::uint16_t>(x, y)[c] = static_cast<std::uint16_t>(sign << 15 | (mantissa & 1023));
    if (format.type == ChannelType::float32)
      image.channels<std::uint32_t>(x, y)[c] = static_cast<std::uint32_t>(sign << 31 | (mantissa & 0x7FFFFF) | (rng.below(3) << 23));
    if (format.type == ChannelType::float32 && rng.coin()) image.channels<float>(x, y)[c] = static_cast<float>(rng.below(256)) / 255;
  }
  return image;
}

// Numbers of at most 4 in a map: coordinates. -0, subnormals and exact texel borders among them.
Image random_map(Rng& rng, int width, int height, ChannelType type) {
  Image map = random_texture(rng, width, height, {type, 2});
  for (std::size_t i = 0; i < 2 * map.texel_count(); ++i) {
    const float value = static_cast<float>(rng.between(-64, 64)) / 16;
    if (type == ChannelType::half && rng.below(4) != 0)
      map.channels<std::uint16_t>(0, 0)[i] = half_nearest_even(static_cast<double>(value));
    if (type == ChannelType::float32 && (rng.below(4) != 0 || std::abs(map.channels<float>(0, 0)[i]) > 8))
      map.channels<float>(0, 0)[i] = value;
  }
  return map;
}

}  // namespace

TEST_CASE("interpolated numbers: every content, format and rounding of halves") {
  GlRenderer* gl = exact_or_skip("exact shader: numbers");
  if (gl == nullptr) return;
  Rng rng(51);
  for (const HalfRounding rounding : {HalfRounding::nearest_even, HalfRounding::toward_zero}) {
    Frame frame = frame_of(*gl, 150, 131, 100, {kIdTarget, kDepthTarget});
    frame.state.half_rounding = rounding;
    frame.state.depth_test = rounding == HalfRounding::nearest_even;
    for (const ChannelType type : kTypes) {
      frame.targets.push_back(color_target(type, 4));
      frame.targets.push_back({TargetContent::coordinate, {type, 2}, {0.5f, 1e-5f}});
      frame.targets.push_back({TargetContent::barycentrics, {type, 3}, {}});
    }
    const std::vector<Image> golden = check_identical(*gl, random_list(rng, frame, 9, 2), frame);
    CHECK(covered(golden[0]) > golden[0].texel_count() / 4);
    CHECK(covered(golden[0]) < golden[0].texel_count());
  }
}

TEST_CASE("all the range of the input: w and attributes over 2^40, positions over the largest guard") {
  GlRenderer* gl = exact_or_skip("exact shader: ranges");
  if (gl == nullptr) return;
  Rng rng(52);
  const auto wide = [&rng](int low, int high, bool either_sign) {
    const float magnitude = std::ldexp(1.0f + static_cast<float>(rng.unit()), static_cast<int>(rng.between(low, high)));
    return either_sign && rng.coin() ? -magnitude : magnitude;
  };
  for (const int guard : {0, 64, 8120}) {
    Frame frame = frame_of(*gl, 144, 120, guard,
                           {kIdTarget,
                            kDepthTarget,
                            color_target(ChannelType::float32, 4),
                            color_target(ChannelType::half, 4),
                            color_target(ChannelType::unorm16, 4),
                            {TargetContent::coordinate, kRg32f, {}},
                            {TargetContent::barycentrics, {ChannelType::float32, 3}, {}}});
    DrawList list = random_list(rng, frame, 80, 1);
    for (RasterVertex& v : list.vertices) {
      if (rng.coin()) v.w = wide(-20, 19, false);
      if (rng.coin()) v.z = wide(-50, -1, false);
      v.uv = {wide(-45, 39, true), rng.coin() ? v.uv.y : -v.uv.x};
      for (int c = 0; c < 4; ++c) v.color[c] = rng.below(4) == 0 ? 0.0f : wide(-45, 39, true);
    }
    // u = −v at the corners of a triangle that all w share: values that cancel to almost nothing, or to nothing.
    for (std::uint32_t t = 0; t + 2 < list.vertices.size(); t += 9) {
      list.vertices[t + 1].color = -list.vertices[t].color;
      list.vertices[t + 2].color = {0, list.vertices[t].color[1], 0, list.vertices[t].color[3] * 0x1p-30f};
    }
    const std::vector<Image> golden = check_identical(*gl, list, frame);
    CHECK(covered(golden[0]) > golden[0].texel_count() / 4);
  }
}

TEST_CASE("nearest texels: every format into every format, every wrap, with ties on every texel border") {
  GlRenderer* gl = exact_or_skip("exact shader: textures");
  if (gl == nullptr) return;
  Rng rng(53);
  for (const ChannelType type : kTypes) {
    Frame frame = frame_of(*gl, 96, 80, 64, {kIdTarget});
    // A program for each pair takes its time to compile: all of them in the full run, which etalon_crosscheck does too.
    for (const ChannelType target : kTypes) {
      if ((std::getenv("ETALON_FULL") != nullptr) || target == type ||
          target == (type == ChannelType::half ? ChannelType::srgb8 : ChannelType::half))
        frame.targets.push_back(color_target(target, 4));
    }
    frame.state.half_rounding = rng.coin() ? HalfRounding::nearest_even : HalfRounding::toward_zero;
    for (const int channels : type == ChannelType::unorm8 ? std::vector<int>{4, 1} : std::vector<int>{4}) {
      DrawList list = random_list(rng, frame, 30, 1);
      list.images = {std::make_shared<const Image>(random_texture(rng, 32, 20, {type, channels}))};
      list.draws[0] = {.triangle_count = list.draws[0].triangle_count,
                       .shading = Shading::texture,
                       .texture = 0,
                       .sampler = {Filter::nearest, Wrap::repeat, Wrap::mirrored_repeat}};
      // One texel for one, shifted by half texels: u·n is an integer at every sample of the first quad.
      add_quad(list, {3, 2}, {40, 50}, {-4.0f / 32, 0}, {33.0f / 32, 2.4f},
               {.shading = Shading::texture, .texture = 0, .sampler = {Filter::nearest, Wrap::clamp, Wrap::repeat}});
      add_quad(list, {30.5, 20.5}, {94.5, 84.5}, {-1, -1.6f}, {1, 1.6f},
               {.shading = Shading::texture, .texture = 0, .sampler = {Filter::nearest, Wrap::mirrored_repeat, Wrap::clamp}});
      for (std::size_t v = list.vertices.size() - 8; v < list.vertices.size(); ++v) list.vertices[v].z = 0;
      check_identical(*gl, list, frame);
    }
  }
}

TEST_CASE("indexed: every format of the map, numbers on texel borders, tiny and negative ones") {
  GlRenderer* gl = exact_or_skip("exact shader: indexed");
  if (gl == nullptr) return;
  Rng rng(54);
  for (const ChannelType type : kTypes) {
    Frame frame = frame_of(*gl, 96, 80, 64, {kIdTarget, color_target(ChannelType::float32, 4)});
    DrawList list = random_list(rng, frame, 30, 1);
    list.images = {std::make_shared<const Image>(random_texture(rng, 51, 32, {ChannelType::float32, 3})),
                   std::make_shared<const Image>(random_map(rng, 24, 24, type))};
    list.draws[0] = {.triangle_count = list.draws[0].triangle_count,
                     .shading = Shading::indexed,
                     .texture = 0,
                     .sampler = {Filter::nearest, Wrap::mirrored_repeat, Wrap::repeat},
                     .indexing_map = 1,
                     .map_sampler = {Filter::nearest, Wrap::repeat, Wrap::clamp}};
    check_identical(*gl, list, frame);
  }
}

TEST_CASE("linear filtering: every format, every wrap, samples on texel centres and half-way between") {
  GlRenderer* gl = exact_or_skip("exact shader: linear");
  if (gl == nullptr) return;
  Rng rng(60);
  for (const ChannelType type : kTypes) {
    // Programs of long integers take seconds to compile.
    if (std::getenv("ETALON_FULL") == nullptr && (type == ChannelType::unorm16 || type == ChannelType::srgb8)) continue;
    const ChannelType other = type == ChannelType::float32 ? ChannelType::unorm8 : type == ChannelType::unorm8 ? ChannelType::srgb8 : type;
    Frame frame = frame_of(*gl, 64, 48, 64, {kIdTarget, color_target(other, 4)});
    frame.state.half_rounding = rng.coin() ? HalfRounding::nearest_even : HalfRounding::toward_zero;
    DrawList list = random_list(rng, frame, 12, 1);
    Image texture = random_texture(rng, 32, 20, {type, type == ChannelType::half ? 3 : 4});
    list.images = {std::make_shared<const Image>(std::move(texture))};
    const auto drawn = [](Wrap wrap_u, Wrap wrap_v) {
      return Draw{.shading = Shading::texture, .texture = 0, .sampler = {Filter::linear, wrap_u, wrap_v}};
    };
    const std::uint32_t count = list.draws[0].triangle_count;
    list.draws[0] = drawn(Wrap::repeat, Wrap::mirrored_repeat);
    list.draws[0].triangle_count = count;
    // u·n − 1/2 is an integer at every sample of the first quad, an odd multiple of 1/2 at those of the second.
    add_quad(list, {3, 2}, {40, 22}, {-4.0f / 32, 0}, {33.0f / 32, 1}, drawn(Wrap::clamp, Wrap::repeat));
    add_quad(list, {30.5, 20.5}, {62.5, 46.5}, {0, -0.3f}, {1, 1}, drawn(Wrap::mirrored_repeat, Wrap::clamp));
    for (std::size_t v = list.vertices.size() - 8; v < list.vertices.size(); ++v) list.vertices[v].z = 0;
    const std::vector<Image> golden = check_identical(*gl, list, frame);
    CHECK(covered(golden[0]) > golden[0].texel_count() / 4);
  }
}

TEST_CASE("linear filtering over the range of the input: w, tiny and huge coordinates, texels over 2^40") {
  GlRenderer* gl = exact_or_skip("exact shader: linear ranges");
  if (gl == nullptr) return;
  Rng rng(61);
  const Frame frame = frame_of(*gl, 64, 48, 700, {kIdTarget, color_target(ChannelType::float32, 2)});
  DrawList list = random_list(rng, frame, 40, 1);
  Image texture(16, 16, {ChannelType::float32, 2});
  for (std::size_t i = 0; i < 2 * texture.texel_count(); ++i) {
    const float magnitude = std::ldexp(1.0f + static_cast<float>(rng.unit()), static_cast<int>(rng.between(-44, 39)));
    texture.channels<float>(0, 0)[i] = rng.coin() ? magnitude : -magnitude;
  }
  list.images = {std::make_shared<const Image>(std::move(texture))};
  for (RasterVertex& v : list.vertices) {
    v.w = std::ldexp(1.0f + static_cast<float>(rng.unit()), static_cast<int>(rng.between(-20, 19)));
    for (int axis = 0; axis < 2; ++axis) v.uv[axis] *= std::ldexp(1.0f, static_cast<int>(rng.between(-45, 23)));
  }
  const std::uint32_t count = list.draws[0].triangle_count;
  list.draws[0] = {
      .triangle_count = count, .shading = Shading::texture, .texture = 0, .sampler = {Filter::linear, Wrap::repeat, Wrap::repeat}};
  const std::vector<Image> golden = check_identical(*gl, list, frame);
  CHECK(covered(golden[0]) > golden[0].texel_count() / 4);
}

TEST_CASE("indexed with linear filters: of the map, of the image, of both") {
  GlRenderer* gl = exact_or_skip("exact shader: indexed linear");
  if (gl == nullptr) return;
  Rng rng(62);
  struct Case {
    Filter filter, map_filter;
    ChannelType map;
  };
  for (const Case& one :
       {Case{Filter::nearest, Filter::linear, ChannelType::unorm16}, Case{Filter::linear, Filter::nearest, ChannelType::float32},
        Case{Filter::linear, Filter::linear, ChannelType::half}, Case{Filter::linear, Filter::linear, ChannelType::float32}}) {
    const Frame frame = frame_of(*gl, 64, 48, 64, {kIdTarget, color_target(ChannelType::unorm16, 4)});
    DrawList list = random_list(rng, frame, 12, 1);
    list.images = {std::make_shared<const Image>(random_texture(rng, 51, 32, {ChannelType::half, 4})),
                   std::make_shared<const Image>(random_map(rng, 24, 24, one.map))};
    list.draws[0] = {.triangle_count = list.draws[0].triangle_count,
                     .shading = Shading::indexed,
                     .texture = 0,
                     .sampler = {one.filter, Wrap::mirrored_repeat, Wrap::repeat},
                     .indexing_map = 1,
                     .map_sampler = {one.map_filter, Wrap::repeat, Wrap::clamp}};
    check_identical(*gl, list, frame);
  }
}

TEST_CASE("several draws: each group of triangles gets its own image and sampler") {
  GlRenderer* gl = exact_or_skip("exact shader: groups");
  if (gl == nullptr) return;
  Rng rng(55);
  const Frame frame = frame_of(*gl, 100, 90, 16, {color_target(ChannelType::unorm8, 3), kIdTarget, kDepthTarget});
  DrawList list = random_list(rng, frame, 64, 1);
  list.draws.clear();
  for (std::uint32_t n = 0; n < 16; ++n) {
    list.images.push_back(std::make_shared<const Image>(random_texture(rng, 8 + static_cast<int>(n), 16, kRgba8)));
    Draw draw{.first_triangle = 4 * n, .triangle_count = 4};
    if (n % 3 != 0) draw.shading = Shading::texture, draw.texture = n / 2;
    if (n % 3 == 1) draw.shading = Shading::indexed, draw.indexing_map = n / 3;
    list.draws.push_back(draw);
  }
  check_identical(*gl, list, frame);
}

TEST_CASE("depth: rounded once and compared, equal depths to the earlier triangle, tiny ones, culling") {
  GlRenderer* gl = exact_or_skip("exact shader: depth");
  if (gl == nullptr) return;
  Rng rng(56);
  for (const CullMode cull : {CullMode::none, CullMode::clockwise, CullMode::counter_clockwise}) {
    Frame frame = frame_of(*gl, 128, 128, 32, {kIdTarget, kDepthTarget});
    frame.state.cull = cull;
    DrawList list = random_list(rng, frame, 40, 1);
    const std::size_t count = list.vertices.size();
    for (std::size_t v = 0; v < count; ++v) {
      RasterVertex copy = list.vertices[v];  // the same planes, moved by at most two steps, or not at all
      copy.z = std::clamp(copy.z + static_cast<float>(rng.between(-1, 1)) * 0x1p-24f, 0.0f, 1.0f);
      list.vertices.push_back(copy);
    }
    for (std::uint32_t t = 0; t < 40; ++t) {
      const auto first = static_cast<std::uint32_t>(count) + 3 * t;
      list.triangles.push_back({first + 2, first + 1, first});
      if (t % 4 == 0)
        for (std::uint32_t k = 0; k < 3; ++k) list.vertices[3 * t + k].z *= 0x1p-39f;
      if (t % 7 == 0)
        for (std::uint32_t k = 0; k < 3; ++k) list.vertices[3 * t + k].z = 1;
    }
    list.draws[0].triangle_count = 80;
    const std::vector<Image> golden = check_identical(*gl, list, frame);
    CHECK(covered(golden[0]) > golden[0].texel_count() / 4);
  }
}

TEST_CASE("an exact tie of depth rounding: half-way between two float32") {
  GlRenderer* gl = exact_or_skip("exact shader: depth ties");
  if (gl == nullptr) return;
  // z = x/2^14 + 2^-12 over a triangle with legs of 2^6 texels: at samples (2i + 1)/2 texels depths need 7 bits beside the offset; with
  // z0 = 1/2 + 2^-24 · odd/2 … the sum of both lies half-way between two float32 for every sample of odd weight.
  const Frame frame = frame_of(*gl, 64, 64, 0, {kIdTarget, kDepthTarget});
  DrawList list = triangle_list({vertex_at(0, 0), vertex_at(64, 0), vertex_at(0, 64)});
  list.vertices[0].z = 0.5f;
  list.vertices[1].z = 0.5f + 0x1p-24f * 64;  // one step of 2^-24 a texel, half a step at the first sample
  list.vertices[2].z = 0.5f;
  const std::vector<Image> golden = check_identical(*gl, list, frame);
  CHECK(*golden[1].channels<float>(0, 0) == 0.5f);             // 1/2 + 2^-25: to even
  CHECK(*golden[1].channels<float>(1, 0) == 0.5f + 0x1p-23f);  // 1/2 + 3·2^-25: to even, upwards
}

TEST_CASE("numbers exactly on the borders of their formats, in perspective: doubles cannot decide a single one") {
  if (exact_or_skip("exact shader: borders") == nullptr) return;
  const std::unique_ptr<Context> context = make_context({.driver = Driver::llvmpipe});
  GlPipeline native(*context);
  ExactPipeline pipeline(*context, native.limits());
  Rng rng(63);
  // All corners of a triangle have the same number a: sum(E·w·w·a) / sum(E·w·w) is a, but no double need say so.
  const auto check_constant = [&](TargetSpec target, HalfRounding rounding, float constant, const Sampler* sampler) {
    Frame frame = frame_of(*exact_or_skip(""), 48, 40, 64, {kIdTarget, target});
    frame.state.half_rounding = rounding;
    DrawList list = random_list(rng, frame, 8, 1);
    for (RasterVertex& v : list.vertices) {
      v.w = rng.uniform(0.25f, 4.0f);
      v.uv = {constant, constant};
      v.color = {constant, constant, constant, constant};
    }
    if (sampler != nullptr) {
      list.images = {std::make_shared<const Image>(random_texture(rng, 12, 12, kRgba8))};
      list.draws[0] = {.triangle_count = list.draws[0].triangle_count, .shading = Shading::texture, .texture = 0, .sampler = *sampler};
    }
    raster::CpuRenderer cpu;
    const std::vector<Image> golden = cpu.render(list, frame);
    CHECK(differing(golden, pipeline.draw(list, frame)) == std::vector<std::size_t>(2, 0));
    REQUIRE(covered(golden[0]) > 100);
    CHECK(pipeline.counters().undecided == covered(golden[0]));
  };
  constexpr HalfRounding kEven = HalfRounding::nearest_even, kZero = HalfRounding::toward_zero;
  check_constant(color_target(ChannelType::unorm8, 4), kEven, 0.5f, nullptr);                   // 127.5
  check_constant(color_target(ChannelType::unorm16, 4), kEven, 0.5f, nullptr);                  // 32767.5
  check_constant(color_target(ChannelType::half, 4), kEven, 1 + 0x1p-11f, nullptr);             // down to even
  check_constant(color_target(ChannelType::half, 4), kEven, -1 - 0x3p-11f, nullptr);            // up to even
  check_constant(color_target(ChannelType::half, 4), kZero, 1 + 0x1p-10f, nullptr);             // a half itself
  check_constant(color_target(ChannelType::half, 4), kEven, 65520, nullptr);                    // inf
  check_constant(color_target(ChannelType::srgb8, 3), kEven, 0x1.dd681c0000000p-12f, nullptr);  // the threshold T_2
  check_constant({TargetContent::coordinate, {ChannelType::half, 2}, {}}, kEven, 1 + 0x1p-11f, nullptr);
  const Sampler nearest{Filter::nearest, Wrap::repeat, Wrap::mirrored_repeat}, linear{Filter::linear, Wrap::repeat, Wrap::clamp};
  check_constant(color_target(ChannelType::unorm8, 4), kEven, 0.25f, &nearest);   // u·12 = 3
  check_constant(color_target(ChannelType::unorm8, 4), kEven, -1.75f, &nearest);  // −21
  check_constant(color_target(ChannelType::unorm8, 4), kEven, 0.625f, &linear);   // u·12 − 1/2 = 7
}

TEST_CASE("more undecided texels than one list takes") {
  if (exact_or_skip("exact shader: lists") == nullptr) return;
  const std::unique_ptr<Context> context = make_context({.driver = Driver::llvmpipe});
  GlPipeline native(*context);
  ExactPipeline pipeline(*context, native.limits());
  Rng rng(64);
  // A copy shifted by half a texel: every sample lies on a border of two texels on both axes.
  constexpr int kSize = 256;
  const Frame frame = frame_of(*exact_or_skip(""), kSize + 8, kSize, 16, {kColorTarget});
  DrawList list;
  list.images = {std::make_shared<const Image>(random_image(kSize, kSize, kRgba8, rng))};
  add_quad(list, {0, 0}, {kSize + 8, kSize}, {0.5f / kSize, 0.5f / kSize}, {(kSize + 8.5f) / kSize, (kSize + 0.5f) / kSize},
           {.shading = Shading::texture, .texture = 0, .sampler = {Filter::nearest, Wrap::repeat, Wrap::repeat}});
  const Image drawn = pipeline.draw(list, frame)[0];
  CHECK(pipeline.counters().undecided == std::uint64_t{kSize + 8} * kSize);  // above 2^16
  std::size_t wrong = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize + 8; ++x)
      wrong += std::equal(drawn.texel(x, y), drawn.texel(x, y) + 4, list.images[0]->texel((x + 1) % kSize, (y + 1) % kSize)) ? 0 : 1;
  CHECK(wrong == 0);
}

TEST_CASE("depths exactly half-way between two float32, of more bits than a double holds") {
  GlRenderer* gl = exact_or_skip("exact shader: depth borders");
  if (gl == nullptr) return;
  // One step of 2^-24 a texel from 1/2 on: at the sample i + 1/2 half-way between two of the float32 that are 2^-24 apart. Areas of 2^37.
  const Frame frame = frame_of(*gl, 256, 256, 4000, {kIdTarget, kDepthTarget});
  DrawList list = triangle_list({vertex_at(-1798, -3000.25), vertex_at(3806, 17.625), vertex_at(-310, 3999.5), vertex_at(-1798, -3000.25),
                                 vertex_at(3806, 17.625), vertex_at(1234, -3501)});
  for (RasterVertex& v : list.vertices) v.z = 0.5f + static_cast<float>(v.x / 256 + 1798) * 0x1p-24f;  // exact
  const std::vector<Image> golden = check_identical(*gl, list, frame);
  CHECK(covered(golden[0]) == golden[0].texel_count());
}

TEST_CASE("integers for every texel give the same bytes as doubles for nearly all") {
  if (exact_or_skip("exact shader: integers") == nullptr) return;
  const std::unique_ptr<Context> context = make_context({.driver = Driver::llvmpipe});
  GlPipeline native(*context);
  ExactPipeline integers(*context, native.limits(), true);
  Rng rng(57);
  Frame frame = frame_of(*exact_or_skip(""), 80, 70, 60,
                         {kIdTarget,
                          kDepthTarget,
                          color_target(ChannelType::float32, 4),
                          color_target(ChannelType::unorm16, 2),
                          {TargetContent::barycentrics, {ChannelType::half, 3}, {}},
                          {TargetContent::coordinate, kRg32f, {}}});
  frame.state.half_rounding = HalfRounding::nearest_even;
  const DrawList list = random_list(rng, frame, 40, 1);
  raster::CpuRenderer cpu;
  const std::vector<Image> golden = cpu.render(list, frame);
  CHECK(differing(golden, integers.draw(list, frame)) == std::vector<std::size_t>(frame.targets.size(), 0));
  CHECK(integers.counters().undecided == 4 * covered(golden[0]));  // two targets of ids and depths, four of numbers

  frame.targets = {kIdTarget, color_target(ChannelType::half, 4)};
  for (const Filter filter : {Filter::nearest, Filter::linear}) {
    DrawList textured = list;
    textured.images = {std::make_shared<const Image>(random_texture(rng, 16, 11, kRgba8))};
    textured.draws = {{.triangle_count = list.draws[0].triangle_count, .shading = Shading::texture, .texture = 0, .sampler = {filter}}};
    CHECK(differing(cpu.render(textured, frame), integers.draw(textured, frame)) == std::vector<std::size_t>(2, 0));
  }
}

TEST_CASE("fewer sub-texel bits, and none more than eight") {
  GlRenderer* gl = exact_or_skip("exact shader: sub-texel bits");
  if (gl == nullptr) return;
  Rng rng(58);
  RasterState wanted;
  wanted.subtexel_bits = 16;
  CHECK(gl->supported_state(wanted).subtexel_bits == 8);
  for (const int bits : {1, 4, 7}) {
    Frame frame = frame_of(*gl, 90, 90, 30, {kIdTarget, kDepthTarget, color_target(ChannelType::float32, 4)});
    frame.state.subtexel_bits = bits;
    check_identical(*gl, random_list(rng, frame, 60, 1), frame);
  }
}

TEST_CASE("what the exact shader supports, and what it refuses in words") {
  GlRenderer* gl = exact_or_skip("exact shader: refusals");
  if (gl == nullptr) return;
  CHECK(gl->shader_mode() == ShaderMode::exact);
  CHECK(gl->name().find("exact shader") != std::string::npos);
  RasterState state;
  state.half_rounding = HalfRounding::nearest_even;
  CHECK(gl->supported_state(state).half_rounding == HalfRounding::nearest_even);
  state.half_rounding = HalfRounding::toward_zero;
  CHECK(gl->supported_state(state).half_rounding == HalfRounding::toward_zero);
  CHECK(gl->supports(color_target(ChannelType::srgb8, 3)));
  CHECK_FALSE(gl->supports({TargetContent::margins, kRgba32f, {}}));

  // Nothing to draw.
  check_identical(*gl, {}, frame_of(*gl, 16, 16, 0, {kIdTarget, color_target(ChannelType::half, 1), color_target(ChannelType::srgb8, 4)}));
}

TEST_CASE("a device whose doubles are not IEEE's is refused by the operation that shows it") {
  if (exact_or_skip("exact shader: probe") == nullptr) return;
  const std::unique_ptr<Context> context = make_context({.driver = Driver::llvmpipe});
  CHECK_NOTHROW(require_operations(context->gl(), ieee_operations(), 4096));
  // What a device without doubles of its own might do: a product of 24 bits.
  const std::vector<DoubleOperation> planted{
      {"product", "double(float(a) * float(b))", [](double a, double b) { return a * b; }},
  };
  CHECK_THROWS_WITH_AS(require_operations(context->gl(), planted, 4096), doctest::Contains("this device's product differs in 40"),
                       UnavailableError);
}
