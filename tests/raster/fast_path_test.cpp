// What the fast path promises beside the bytes: levels by name, ties decided without wide integers, few values left to them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "raster/double_double.h"
#include "raster/narrow_split.h"
#include "raster/simd_level.h"
#include "tests/raster/draw_helpers.h"

using namespace etalon;
using namespace etalon::test;

namespace {

std::shared_ptr<Image> noise(Rng& rng, int width, int height, PixelFormat format) {
  auto image = std::make_shared<Image>(width, height, format);
  if (format.type == ChannelType::float32) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < format.channels; ++c) image->channels<float>(x, y)[c] = rng.uniform(-3, 3);
  } else {
    for (std::byte& b : image->bytes()) b = static_cast<std::byte>(rng.below(256));
  }
  return image;
}

// The frame as two triangles; texel (i, j) looks up (i + shift, j + shift) of an image of the frame's size.
DrawList shifted_screen(Rng& rng, const Frame& frame, float shift, const Sampler& sampler, PixelFormat format) {
  const int w = frame.width << frame.state.subtexel_bits, h = frame.height << frame.state.subtexel_bits;
  const auto u = [&](int x) { return (static_cast<float>(x) * static_cast<float>(frame.width) + shift) / static_cast<float>(frame.width); };
  const auto vertex = [&](int x, int y) {
    RasterVertex v;
    v.x = x * w, v.y = y * h, v.uv = {u(x), u(y)};
    return v;
  };
  DrawList list = list_of({vertex(0, 0), vertex(1, 0), vertex(1, 1), vertex(0, 0), vertex(1, 1), vertex(0, 1)});
  list.images = {noise(rng, frame.width, frame.height, format)};
  list.draws = {{.first_triangle = 0, .triangle_count = 2, .shading = Shading::texture, .texture = 0, .sampler = sampler}};
  return list;
}

}  // namespace

TEST_CASE("SIMD levels have names, and only those of this machine can be set") {
  const auto levels = raster::available_simd_levels();
  REQUIRE(!levels.empty());
  CHECK(levels.front() == raster::SimdLevel::baseline);
  CHECK(raster::simd_level() == levels.back());
  for (const raster::SimdLevel level : levels) {
    CHECK(raster::parse_simd_level(raster::to_string(level)) == level);
    raster::set_simd_level(level);
    CHECK(raster::simd_level() == level);
  }
  raster::set_simd_level(levels.back());
  CHECK(!raster::parse_simd_level("avx1024"));
  for (const raster::SimdLevel level : {raster::SimdLevel::neon, raster::SimdLevel::avx512})
    if (std::find(levels.begin(), levels.end(), level) == levels.end()) CHECK_THROWS_AS(raster::set_simd_level(level), InputError);
  CHECK(raster::simd_level() == levels.back());
}

TEST_CASE("a narrow split is floor and remainder") {
  Rng rng(7);
  for (int round = 0; round < 20000; ++round) {
    const int d_bits = 1 + static_cast<int>(rng.below(94)), index_bits = static_cast<int>(rng.below(31));
    const auto wide = [&](int bits) {
      const __int128 all = (static_cast<__int128>(rng.below(~std::uint64_t{0})) << 64) | rng.below(~std::uint64_t{0});
      return static_cast<__int128>(static_cast<unsigned __int128>(all) >> (128 - bits));
    };
    const __int128 d = wide(d_bits) + 1;
    const std::int64_t index = rng.between(-(std::int64_t{1} << index_bits), std::int64_t{1} << index_bits);
    const __int128 rest = round % 3 == 0 ? 0 : round % 3 == 1 ? d - 1 : wide(d_bits) % d;
    const auto split = raster::narrow_split(index * d + rest, d);
    CHECK(split.index == index);
    const double fraction = static_cast<double>(rest) / static_cast<double>(d);
    CHECK(std::abs(split.fraction - fraction) <= fraction * 0x1p-51);
  }
}

TEST_CASE("double-double sums and products are exact, quotients within 2^-98") {
  Rng rng(8);
  const auto integer = [](raster::DoubleDouble a) { return static_cast<__int128>(a.high) + static_cast<__int128>(a.low); };
  for (int round = 0; round < 20000; ++round) {
    const auto number = [&] { return rng.between(-(std::int64_t{1} << 52), std::int64_t{1} << 52) >> rng.below(40); };
    const std::int64_t a = number(), b = number();
    const auto x = static_cast<double>(a), y = static_cast<double>(b);
    CHECK(integer(raster::two_sum(x, y)) == static_cast<__int128>(a) + b);
    CHECK(integer(raster::two_product(x, y)) == static_cast<__int128>(a) * b);
    const std::int64_t wide = a * 512 + b;
    CHECK(integer(raster::double_double(wide)) == wide);
    if (b == 0) continue;
    // (a·b/3)/b·3 − a: two quotients and a product, against what 2^-98 of a leaves.
    const raster::DoubleDouble third = raster::two_product(x, y) / raster::DoubleDouble{3, 0};
    const raster::DoubleDouble back = third / raster::DoubleDouble{y, 0} * 3.0 + raster::DoubleDouble{-x, 0};
    CHECK(std::abs(back.high) <= std::abs(x) * 0x1p-98);
  }
}

TEST_CASE("a screen of true ties needs no integers a texel: its planes are exact") {
  Rng rng(3);
  for (const int size : {64, 100, 256})
    for (const float shift : {0.5f, 0.0f, -7.5f, 3.0f})
      for (const Filter filter : {Filter::nearest, Filter::linear})
        for (const Wrap wrap : {Wrap::clamp, Wrap::repeat, Wrap::mirrored_repeat})
          for (const PixelFormat format : {kRgba8, kRg32f}) {
            const Frame frame = frame_of(size, size, {{TargetContent::color, format}});
            const DrawList list = shifted_screen(rng, frame, shift, {filter, wrap, wrap}, format);
            raster::CpuRenderer fast, exact(raster::Evaluation::exact);
            CHECK(fast.render(list, frame) == exact.render(list, frame));
            const bool dyadic = (size & (size - 1)) == 0;  // otherwise the map is not the exact shift: (i + ½)/100 is no float32
            if (filter == Filter::linear && shift != std::floor(shift)) continue;  // means of two and four texels: ties of the rounding
            if (dyadic) CHECK(fast.counters().scalar == 0);
            CHECK(fast.counters().exact_path == 0);
          }
}

TEST_CASE("margins of linear lookups where ½ does not fit the grid of an exact plane") {
  struct Case {
    int image_width;
    float u0, u1;
  };
  const float tiny = 0x1p-26f, far = -0.25f + 512 * 0x1p-26f;
  for (const Case& c : {Case{1, tiny, std::nextafter(tiny, 1.0f)}, Case{32767, far, far + 3 * 0x1p-26f}}) {
    Frame frame = frame_of(64, 64, {{TargetContent::margins, kRgba32f}});
    frame.guard = 8160;
    DrawList list = list_of({at(-32, -32, c.u0, 0.3f), at(8160, -32, c.u1, 0.3f), at(-32, 8160, c.u0, 0.3f)}, Shading::texture);
    for (RasterVertex& v : list.vertices) v.z = 0.5f;
    list.images = {std::make_shared<Image>(c.image_width, 1, PixelFormat{ChannelType::unorm8, 1})};
    list.draws[0].texture = 0, list.draws[0].sampler.filter = Filter::linear;
    raster::CpuRenderer fast, exact(raster::Evaluation::exact);
    CHECK(fast.render(list, frame) == exact.render(list, frame));
  }
}

TEST_CASE("away from ties fewer than one value in 100,000 is left to wide integers") {
  Rng rng(11);
  for (const bool perspective : {false, true})
    for (const Filter filter : {Filter::nearest, Filter::linear})
      for (const PixelFormat format : {kRgba8, kRgba32f}) {
        const Frame frame =
            frame_of(500, 400, {{TargetContent::color, format}, {TargetContent::coordinate, kRg32f}, {TargetContent::depth, kR32f}});
        std::vector<RasterVertex> vertices;
        for (int n = 0; n < 300; ++n) {
          RasterVertex v;
          v.x = static_cast<std::int32_t>(rng.between(-20 << 8, 520 << 8)),
          v.y = static_cast<std::int32_t>(rng.between(-20 << 8, 420 << 8));
          v.z = rng.uniform(0, 1), v.w = perspective ? rng.uniform(0.5f, 5) : 1;
          v.uv = {rng.uniform(-1, 2), rng.uniform(-1, 2)};
          vertices.push_back(v);
        }
        DrawList list = list_of(vertices);
        list.images = {noise(rng, 300, 257, kRgba8), noise(rng, 300, 257, kRgba32f)};
        list.draws = {{.first_triangle = 0,
                       .triangle_count = 100,
                       .shading = Shading::texture,
                       .texture = format == kRgba8 ? 0u : 1u,
                       .sampler = {filter, Wrap::repeat, Wrap::clamp}}};
        raster::CpuRenderer renderer;
        (void)renderer.render(list, frame);
        CHECK(renderer.counters().values > 1'000'000);
        CHECK(renderer.counters().exact_path * 100'000 < renderer.counters().values);
      }
}

TEST_CASE("images may be reused, whatever they were") {
  Rng rng(5);
  raster::CpuRenderer renderer;
  std::vector<Image> images;
  for (const int size : {64, 64, 100, 7}) {
    const Frame frame = frame_of(size, size, {{TargetContent::color, size == 7 ? kRg32f : kRgba8}, {TargetContent::triangle_id, kR32ui}});
    const DrawList list = shifted_screen(rng, frame, 0.25f, {}, frame.targets[0].format);
    renderer.render_into(list, frame, images);
    CHECK(images == renderer.render(list, frame));
  }
}
