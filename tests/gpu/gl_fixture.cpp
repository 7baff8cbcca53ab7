#include "tests/gpu/gl_fixture.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "tests/support/skip.h"

#ifndef ETALON_TEST_PLATFORM
#define ETALON_TEST_PLATFORM osmesa
#endif

namespace etalon::gpu::test {

namespace {

struct SharedRenderer {
  std::unique_ptr<GlRenderer> renderer;
  std::string reason;

  SharedRenderer() {
    try {
      renderer = std::make_unique<GlRenderer>(ContextOptions{.platform = Platform::ETALON_TEST_PLATFORM, .driver = Driver::llvmpipe});
    } catch (const UnavailableError& error) {
      reason = error.what();
    }
  }
};

bool owns_edge(std::int64_t dx, std::int64_t dy) { return dy < 0 || (dy == 0 && dx > 0); }

}  // namespace

GlRenderer* renderer_or_skip(const std::string& test_case) {
  static SharedRenderer shared;
  if (!shared.renderer) etalon::test::report_skip(test_case, shared.reason);
  return shared.renderer.get();
}

Frame frame_of(const GlRenderer& renderer, int width, int height, int guard, std::vector<TargetSpec> targets) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.guard = guard;
  frame.state = renderer.supported_state({});
  frame.targets = std::move(targets);
  return frame;
}

RasterVertex vertex_at(double x_texel, double y_texel, Vec2f uv, Vec4f color, float z) {
  return {.x = static_cast<std::int32_t>(x_texel * 256),
          .y = static_cast<std::int32_t>(y_texel * 256),
          .z = z,
          .w = 1,
          .uv = uv,
          .color = color};
}

DrawList triangle_list(std::vector<RasterVertex> vertices) {
  DrawList list;
  list.vertices = std::move(vertices);
  for (std::uint32_t i = 0; i + 2 < list.vertices.size(); i += 3) list.triangles.push_back({i, i + 1, i + 2});
  list.draws.push_back({.first_triangle = 0, .triangle_count = static_cast<std::uint32_t>(list.triangles.size())});
  return list;
}

void add_quad(DrawList& list, Vec2d lo_texel, Vec2d hi_texel, Vec2f uv_lo, Vec2f uv_hi, Draw shading) {
  const auto base = static_cast<std::uint32_t>(list.vertices.size());
  list.vertices.push_back(vertex_at(lo_texel.x, lo_texel.y, uv_lo));
  list.vertices.push_back(vertex_at(hi_texel.x, lo_texel.y, {uv_hi.x, uv_lo.y}));
  list.vertices.push_back(vertex_at(hi_texel.x, hi_texel.y, uv_hi));
  list.vertices.push_back(vertex_at(lo_texel.x, hi_texel.y, {uv_lo.x, uv_hi.y}));
  shading.first_triangle = static_cast<std::uint32_t>(list.triangles.size());
  shading.triangle_count = 2;
  list.triangles.push_back({base, base + 1, base + 2});
  list.triangles.push_back({base, base + 2, base + 3});
  list.draws.push_back(shading);
}

DrawList textured_quad(const Image& texture, int width, int height, const Sampler& sampler) {
  DrawList list;
  list.images.push_back(std::make_shared<const Image>(texture));
  add_quad(list, {0, 0}, {width, height}, {0, 0}, {1, 1}, {.shading = Shading::texture, .texture = 0, .sampler = sampler});
  return list;
}

Image random_image(int width, int height, PixelFormat format, Rng& rng) {
  Image image(width, height, format);
  const std::size_t count = image.texel_count() * static_cast<std::size_t>(format.channels);
  for (std::size_t i = 0; i < count; ++i) {
    switch (format.type) {
      case ChannelType::unorm8:
      case ChannelType::srgb8: image.channels<std::uint8_t>(0, 0)[i] = static_cast<std::uint8_t>(rng.below(256)); break;
      case ChannelType::unorm16: image.channels<std::uint16_t>(0, 0)[i] = static_cast<std::uint16_t>(rng.below(65536)); break;
      case ChannelType::half:  // sign, exponent 1..30, any mantissa
        image.channels<std::uint16_t>(0, 0)[i] =
            static_cast<std::uint16_t>(rng.below(2) << 15 | (1 + rng.below(30)) << 10 | rng.below(1024));
        break;
      case ChannelType::float32: image.channels<float>(0, 0)[i] = rng.uniform(-1000, 1000); break;
      case ChannelType::uint32: image.channels<std::uint32_t>(0, 0)[i] = static_cast<std::uint32_t>(rng.next()); break;
    }
  }
  return image;
}

std::vector<std::uint32_t> reference_ids(const DrawList& list, const Frame& frame) {
  const std::int64_t one = std::int64_t{1} << frame.state.subtexel_bits;
  std::vector<std::uint32_t> ids(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height), kNoTriangle);
  for (std::size_t t = 0; t < list.triangles.size(); ++t) {
    std::array<std::array<std::int64_t, 2>, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = {list.vertices[list.triangles[t][k]].x, list.vertices[list.triangles[t][k]].y};
    const std::int64_t area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
    if (area == 0) continue;
    if (area < 0) std::swap(p[1], p[2]);
    // Samples of texel i lie inside [i, i + 1), so texels outside the bounding box have none inside the triangle.
    const auto first_texel = [&](std::size_t axis) {
      return std::max<std::int64_t>(0, std::min({p[0][axis], p[1][axis], p[2][axis]}) / one - 1);
    };
    const auto end_texel = [&](std::size_t axis, std::int64_t size) {
      return std::min<std::int64_t>(size, std::max({p[0][axis], p[1][axis], p[2][axis]}) / one + 1);
    };
    for (std::int64_t row = first_texel(1); row < end_texel(1, frame.height); ++row) {
      for (std::int64_t column = first_texel(0); column < end_texel(0, frame.width); ++column) {
        const std::int64_t x = column * one + one / 2;
        const std::int64_t y = row * one + one / 2;
        bool covered = true;
        for (std::size_t k = 0; k < 3 && covered; ++k) {
          const auto& a = p[k];
          const auto& b = p[(k + 1) % 3];
          const std::int64_t dx = b[0] - a[0];
          const std::int64_t dy = b[1] - a[1];
          const std::int64_t e = dx * (y - a[1]) - dy * (x - a[0]);
          covered = e > 0 || (e == 0 && owns_edge(dx, dy));
        }
        if (covered) ids[static_cast<std::size_t>(row * frame.width + column)] = static_cast<std::uint32_t>(t);
      }
    }
  }
  return ids;
}

std::size_t count_different(const Image& ids, const std::vector<std::uint32_t>& expected) {
  const auto* drawn = ids.channels<std::uint32_t>(0, 0);
  std::size_t count = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) count += drawn[i] != expected[i] ? 1 : 0;
  return count;
}

}  // namespace etalon::gpu::test
