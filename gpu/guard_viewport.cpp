#include "gpu/guard_viewport.h"

#include <bit>

namespace etalon::gpu {

namespace {

/// Smallest power of two >= extent_texel and >= 2: then half of it is a whole number of texels.
int viewport_extent_texel(int extent_texel) {
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(extent_texel < 2 ? 2 : extent_texel)));
}

float clip_coordinate(std::int32_t position_subtexel, int origin_texel, int extent_texel, int subtexel_bits, double w) {
  const std::int64_t half_subtexel = static_cast<std::int64_t>(extent_texel / 2) << subtexel_bits;
  const std::int64_t center_subtexel = (static_cast<std::int64_t>(origin_texel) << subtexel_bits) + half_subtexel;
  const double ndc = static_cast<double>(position_subtexel - center_subtexel) / static_cast<double>(half_subtexel);
  return static_cast<float>(ndc * w);
}

}  // namespace

GuardViewport guard_viewport(const Frame& frame) {
  GuardViewport viewport;
  viewport.width = viewport_extent_texel(frame.width + 2 * frame.guard);
  viewport.height = viewport_extent_texel(frame.height + 2 * frame.guard);
  // The room is at least 2·guard, so each side keeps at least guard (integer halves: the larger half may go to the right).
  viewport.x = -((viewport.width - frame.width) / 2);
  viewport.y = -((viewport.height - frame.height) / 2);
  return viewport;
}

std::array<Vec4f, 3> clip_positions(const std::array<RasterVertex, 3>& triangle, const GuardViewport& viewport, int subtexel_bits) {
  const bool affine = triangle[0].w == triangle[1].w && triangle[1].w == triangle[2].w;
  std::array<Vec4f, 3> clip;
  for (int i = 0; i < 3; ++i) {
    const double w = affine ? 1.0 : static_cast<double>(triangle[i].w);
    const double z_ndc = 2.0 * static_cast<double>(triangle[i].z) - 1.0;
    clip[i] = Vec4f(clip_coordinate(triangle[i].x, viewport.x, viewport.width, subtexel_bits, w),
                    clip_coordinate(triangle[i].y, viewport.y, viewport.height, subtexel_bits, w), static_cast<float>(z_ndc * w),
                    static_cast<float>(w));
  }
  return clip;
}

}  // namespace etalon::gpu
