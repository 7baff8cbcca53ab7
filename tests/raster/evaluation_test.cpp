// The theorem: enclosures in double and wide integers give the same bytes, on any number of threads.
#include <doctest/doctest.h>

#include "core/base/parallel.h"
#include "core/base/rng.h"
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

// 24 overlapping triangles; every third on whole or half texels, so that ties are met.
DrawList random_list(Rng& rng, const Frame& frame, bool perspective) {
  const int bits = frame.state.subtexel_bits;
  std::vector<RasterVertex> vertices;
  for (int n = 0; n < 72; ++n) {
    RasterVertex v;
    const bool coarse = n / 3 % 3 == 0;
    const int shift = coarse ? bits - 1 : 0;
    v.x = static_cast<std::int32_t>(rng.between(-(20 << (bits - shift)), (frame.width + 20) << (bits - shift)) << shift);
    v.y = static_cast<std::int32_t>(rng.between(-(20 << (bits - shift)), (frame.height + 20) << (bits - shift)) << shift);
    v.z = rng.uniform(0, 1);
    v.w = perspective ? rng.uniform(0.3f, 4) : 1;
    v.uv = coarse ? Vec2f(static_cast<float>(rng.between(-8, 8)) / 8, static_cast<float>(rng.between(-8, 8)) / 8)
                  : Vec2f(rng.uniform(-2, 2), rng.uniform(-2, 2));
    for (int c = 0; c < 4; ++c) v.color[c] = coarse ? static_cast<float>(rng.below(3)) / 2 : rng.uniform(-0.2f, 1.2f);
    vertices.push_back(v);
  }
  DrawList list = list_of(vertices);
  list.images = {noise(rng, 37, 20, kRgba8), noise(rng, 16, 16, kRgba32f), noise(rng, 16, 16, {ChannelType::unorm16, 2}),
                 noise(rng, 8, 8, {ChannelType::srgb8, 4}), noise(rng, 23, 18, kRg32f)};
  list.draws.clear();
  for (std::uint32_t n = 0; n < 6; ++n) {
    Draw draw;
    draw.first_triangle = 4 * n, draw.triangle_count = 4;
    draw.shading = static_cast<Shading>(n % 3);
    draw.texture = static_cast<std::uint32_t>(rng.below(5)), draw.indexing_map = static_cast<std::uint32_t>(1 + rng.below(2));
    for (Sampler* sampler : {&draw.sampler, &draw.map_sampler})
      *sampler = {static_cast<Filter>(rng.below(2)), static_cast<Wrap>(rng.below(3)), static_cast<Wrap>(rng.below(3))};
    list.draws.push_back(draw);
  }
  return list;
}

const std::vector<TargetSpec> kEveryTarget = {{TargetContent::color, kRgba8},
                                              {TargetContent::color, {ChannelType::srgb8, 4}},
                                              {TargetContent::color, {ChannelType::unorm16, 3}},
                                              {TargetContent::color, {ChannelType::half, 4}},
                                              {TargetContent::color, kRgba32f},
                                              {TargetContent::color, kRg32f},
                                              {TargetContent::coordinate, kRg32f},
                                              {TargetContent::coordinate, {ChannelType::half, 2}},
                                              {TargetContent::barycentrics, {ChannelType::float32, 3}},
                                              {TargetContent::triangle_id, kR32ui},
                                              {TargetContent::depth, kR32f},
                                              {TargetContent::margins, kRgba32f},
                                              {TargetContent::bound_terms, kRg32f}};

}  // namespace

TEST_CASE("vectors, enclosures and plain integers store the same bytes, at every SIMD level") {
  Rng rng(2026);
  raster::EvaluationCounters total, total_vectorised;
  for (int round = 0; round < 48; ++round) {
    Frame frame = frame_of(90, 70, kEveryTarget);
    frame.state.subtexel_bits = 1 + round % 16;
    frame.guard = round % 16 > 12 ? 20 : 2048;
    frame.state.half_rounding = static_cast<HalfRounding>(round / 2 % 2);
    frame.state.depth_test = round % 5 != 0;
    const DrawList list = random_list(rng, frame, round % 2 == 1);
    raster::CpuRenderer filtered(raster::Evaluation::filtered), exact(raster::Evaluation::exact);
    const auto a = filtered.render(list, frame), b = exact.render(list, frame);
    for (std::size_t n = 0; n < a.size(); ++n) CHECK_MESSAGE(a[n] == b[n], "round ", round, ", ", to_string(frame.targets[n].content));
    CHECK(exact.counters().exact_path == exact.counters().values);
    total += filtered.counters();
    for (const raster::SimdLevel level : raster::available_simd_levels()) {
      raster::set_simd_level(level);
      raster::CpuRenderer vectorised(raster::Evaluation::vectorised);
      const auto c = vectorised.render(list, frame);
      for (std::size_t n = 0; n < a.size(); ++n)
        CHECK_MESSAGE(c[n] == b[n], to_string(level), ", round ", round, ", ", to_string(frame.targets[n].content), " ",
                      to_string(frame.targets[n].format));
      total_vectorised += vectorised.counters();
    }
  }
  raster::set_simd_level(raster::available_simd_levels().back());
  // Ties are planted, yet doubles decide nearly everything; were the enclosures never used, the two ways would be one.
  CHECK(total.exact_path > 0);
  CHECK(total.exact_path < total.values / 100);
  MESSAGE("vectorised: ", total_vectorised.values, " values, ", total_vectorised.scalar, " scalar, ", total_vectorised.exact_path,
          " exact");
}

TEST_CASE("the same bytes on 1, 2 and 7 threads") {
  Rng rng(9);
  const Frame frame = frame_of(200, 150, kEveryTarget);
  const DrawList list = random_list(rng, frame, true);
  raster::CpuRenderer renderer;
  std::vector<Image> first;
  for (const int threads : {1, 2, 7}) {
    set_thread_count(threads);
    const auto images = renderer.render(list, frame);
    if (first.empty()) first = images;
    CHECK(images == first);
  }
  set_thread_count(0);
}
