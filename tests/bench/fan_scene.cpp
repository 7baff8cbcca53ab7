#include "tests/bench/fan_scene.h"

#include <cmath>
#include <memory>

#include "core/base/rng.h"
#include "core/procedural/smooth_math.h"

namespace etalon::bench {
namespace {

constexpr int kSize = 1024;
constexpr int kSubtexels = 256;
constexpr double kRadius_texel = 5.977;  ///< a decagon of circumradius r has 5·sin(36°)·r² = 2.939·r²: 105 texels
constexpr double kWarp_texel = 0.7;
/// Of a centre from the border of its half: radius, warp and what nearest lookup and snapping can add.
constexpr double kMargin_texel = 8;

std::shared_ptr<const Image> source_map() {
  auto map = std::make_shared<Image>(kSize, kSize, kRg32f);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      auto* value = map->channels<float>(x, y);
      value[0] = (static_cast<float>(x) + 0.5f) / kSize;
      value[1] = (static_cast<float>(y) + 0.5f) / kSize;
    }
  return map;
}

RasterVertex fan_vertex(const Vec2d& position_texel, const Vec2d& warp_texel) {
  RasterVertex v;
  v.x = static_cast<std::int32_t>(std::floor(position_texel.x * kSubtexels));
  v.y = static_cast<std::int32_t>(std::floor(position_texel.y * kSubtexels));
  v.uv = Vec2f((position_texel + warp_texel) / static_cast<double>(kSize));
  return v;
}

}  // namespace

BenchScene fan_scene(std::uint32_t fan_count) {
  BenchScene scene{{}, {.width = kSize, .height = kSize, .guard = 0, .state = {}, .targets = {{TargetContent::color, kRg32f}}}};
  scene.frame.state.depth_test = false;
  DrawList& list = scene.list;
  list.images = {source_map()};
  Rng rng(3);
  const auto warp = [&] { return Vec2d{(2 * rng.unit() - 1) * kWarp_texel, (2 * rng.unit() - 1) * kWarp_texel}; };
  for (std::uint32_t fan = 0; fan < fan_count; ++fan) {
    const double half = kSize / 2.0;
    const Vec2d center{(fan % 2) * half + kMargin_texel + rng.unit() * (half - 2 * kMargin_texel),
                       kMargin_texel + rng.unit() * (kSize - 2 * kMargin_texel)};
    const double turn = rng.unit();
    const auto hub = static_cast<std::uint32_t>(list.vertices.size());
    list.vertices.push_back(fan_vertex(center, warp()));
    for (std::uint32_t k = 0; k < kFanTriangles; ++k) {
      const double a = turn + static_cast<double>(k) / kFanTriangles;
      list.vertices.push_back(fan_vertex(center + kRadius_texel * Vec2d(procedural::cos_turns(a), procedural::sin_turns(a)), warp()));
      list.triangles.push_back({hub, hub + 1 + k, hub + 1 + (k + 1) % kFanTriangles});
    }
  }
  list.draws = {{.triangle_count = fan_count * kFanTriangles,
                 .shading = Shading::texture,
                 .texture = 0,
                 .sampler = {Filter::nearest, Wrap::clamp, Wrap::clamp},
                 .map_sampler = {}}};
  return scene;
}

}  // namespace etalon::bench
