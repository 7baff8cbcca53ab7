// Texels as exact numbers, and the wrap of their indices (docs/contract.md#values).
#pragma once

#include <array>
#include <cstdint>

#include "core/draw/state.h"
#include "core/image/image.h"

namespace etalon::raster {

/// The number m · 2^e / den, den one of 1, 255, 65535.
struct TexelValue {
  std::int64_t m = 0;
  int e = 0;
  int den = 1;
  [[nodiscard]] double approximate() const;  ///< within 2^-52 relative
};

/// Channel c of texel (x, y), decoded; absent channels are 0, 0, 1. `filtered`: numbers below 2^-40 count as 0.
[[nodiscard]] TexelValue texel_value(const Image& image, int x, int y, int c, bool filtered);

/// A finite float32 as an exact number (−0 is 0).
[[nodiscard]] TexelValue exact_number(float value);

/// The texel index in [0, size) that index i (of any size below 2^50) names.
[[nodiscard]] int wrapped(std::int64_t i, int size, Wrap wrap);

/// Most bits a filtered texel's integer takes after the four have one scale: 104 for float32 (2^40 down to 2^-63).
[[nodiscard]] int filtered_texel_bits(ChannelType type);

}  // namespace etalon::raster
