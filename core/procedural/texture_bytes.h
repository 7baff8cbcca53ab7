// Writing a painted colour into an RGB unorm8 texel.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/image/image.h"
#include "core/procedural/smooth_math.h"

namespace etalon::procedural {

/// round-half-up(255·c) of each channel, c clamped to [0, 1]; the image is kRgb8.
inline void store_rgb8(Image& image, int x, int y, const Vec3d& color) {
  auto* texel = image.channels<std::uint8_t>(x, y);
  for (int k = 0; k < 3; ++k) texel[k] = static_cast<std::uint8_t>(std::floor(clamp01(color[k]) * 255 + 0.5));
}

}  // namespace etalon::procedural
