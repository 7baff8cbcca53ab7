// The arithmetic on the way to OpenGL, without OpenGL.
#include "gpu/guard_viewport.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <doctest/doctest.h>

#include "core/base/rng.h"

using namespace etalon;
using namespace etalon::gpu;

namespace {

Frame frame_of(int width, int height, int guard) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.guard = guard;
  return frame;
}

}  // namespace

TEST_CASE("the viewport is the smallest power of two around frame and guard") {
  CHECK(guard_viewport(frame_of(1024, 512, 2048)) == GuardViewport{-3584, -3840, 8192, 8192});
  CHECK(guard_viewport(frame_of(1, 1, 0)) == GuardViewport{0, 0, 2, 2});
  CHECK(guard_viewport(frame_of(16384, 12288, 0)) == GuardViewport{0, -2048, 16384, 16384});
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const int width = static_cast<int>(rng.between(1, 16384));
    const int guard = static_cast<int>(rng.between(0, (16384 - width) / 2));
    const Frame frame = frame_of(width, width, guard);
    const GuardViewport viewport = guard_viewport(frame);
    CHECK(std::has_single_bit(static_cast<unsigned>(viewport.width)));
    CHECK(viewport.width <= 16384);
    CHECK(viewport.width / 2 < std::max(width + 2 * guard, 2));
    CHECK(viewport.x <= -guard);
    CHECK(viewport.x + viewport.width >= width + guard);
  }
}

TEST_CASE("affine triangles reach the device at their exact sub-texels") {
  Rng rng(2);
  for (int i = 0; i < 20000; ++i) {
    const int width = static_cast<int>(rng.between(1, 16384));
    const Frame frame = frame_of(width, width, static_cast<int>(rng.between(0, (16384 - width) / 2)));
    const GuardViewport viewport = guard_viewport(frame);
    std::array<RasterVertex, 3> triangle;
    for (RasterVertex& v : triangle) {
      v.x = static_cast<std::int32_t>(rng.between(-frame.guard * 256, (frame.width + frame.guard) * 256));
      v.y = static_cast<std::int32_t>(rng.between(-frame.guard * 256, (frame.height + frame.guard) * 256));
      v.w = 0.37f;  // equal on the triangle: affine
    }
    const auto clip = clip_positions(triangle, viewport, 8);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(clip[k].w == 1.0f);
      // What a device computes in float32, fused or not.
      const float scale = static_cast<float>(viewport.width) / 2;
      const float offset = static_cast<float>(viewport.x) + scale;
      CHECK(clip[k].x * scale + offset == static_cast<float>(triangle[k].x) / 256);
      CHECK(std::fma(clip[k].x, scale, offset) == static_cast<float>(triangle[k].x) / 256);
      CHECK(clip[k].y * scale + (static_cast<float>(viewport.y) + scale) == static_cast<float>(triangle[k].y) / 256);
    }
  }
}

TEST_CASE("perspective vertices are displaced by less than the stated bound, which is below half a sub-texel") {
  Rng rng(3);
  for (const int width : {512, 2048, 8192, 12288, 16384}) {
    const Frame frame = frame_of(width, width, 0);
    const GuardViewport viewport = guard_viewport(frame);
    const double u = 0x1p-24;
    const double half = viewport.width / 2.0;
    const double bound =
        3 * u * (1 + 2 * u) * half + u * std::bit_ceil(static_cast<unsigned>(std::max(-viewport.x, viewport.x + viewport.width))) / 2;
    double worst = 0;
    for (int i = 0; i < 40000; ++i) {
      std::array<RasterVertex, 3> triangle;
      for (RasterVertex& v : triangle) {
        v.x = static_cast<std::int32_t>(rng.between(0, frame.width * 256));
        v.w = rng.uniform(0.3f, 3.6f);
      }
      for (const Vec4f& c : clip_positions(triangle, viewport, 8)) CHECK(std::abs(c.x) <= c.w);
      const Vec4f clip = clip_positions(triangle, viewport, 8)[0];
      const float reciprocal = 1.0f / clip.w;
      const float normalized = clip.x * reciprocal;
      const float x_device = std::fma(normalized, static_cast<float>(half), static_cast<float>(viewport.x + half));
      worst = std::max(worst, std::abs(static_cast<double>(x_device) - triangle[0].x / 256.0));
      CHECK(std::nearbyint(static_cast<double>(x_device) * 256) == triangle[0].x);
    }
    CHECK(worst <= bound);
    CHECK(bound * 256 <= 0.5 * (1 + 2 * u));
    CHECK(worst > 0);
  }
}

TEST_CASE("depth reaches the device within the stated bound") {
  Rng rng(4);
  const GuardViewport viewport = guard_viewport(frame_of(64, 64, 0));
  const double u = 0x1p-24;
  for (int i = 0; i < 60000; ++i) {
    std::array<RasterVertex, 3> triangle;
    for (RasterVertex& v : triangle) {
      v.z = i % 3 == 0 ? rng.uniform(0, 1) : i % 3 == 1 ? rng.uniform(0, 0x1p-12f) : 1 - rng.uniform(0, 0x1p-12f);
      v.w = i % 2 == 0 ? 1.0f : rng.uniform(0.3f, 3.6f);
    }
    const bool affine = i % 2 == 0;
    const Vec4f clip = clip_positions(triangle, viewport, 8)[0];
    const float normalized = clip.z * (1.0f / clip.w);
    const double z_device = std::fma(normalized, 0.5f, 0.5f);
    const double z = triangle[0].z;
    const double relative = affine ? u : 3 * u * (1 + 2 * u);
    CHECK(std::abs(z_device - z) <= relative * std::abs(2 * z - 1) / 2 + u / 2);
  }
  std::array<RasterVertex, 3> ends;
  ends[0].z = 0;
  ends[1].z = 1;
  ends[2].z = 0.5f;
  const auto clip = clip_positions(ends, viewport, 8);
  CHECK(clip[0].z == -1.0f);
  CHECK(clip[1].z == 1.0f);
  CHECK(clip[2].z == 0.0f);
}
