// Positions, depths, w and attributes of random triangles, by category.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/rng.h"
#include "core/draw/draw_list.h"

namespace etalon::validation::reference {

/// Where vertices may lie, in sub-texels, and what their numbers may be.
struct TriangleDomain {
  std::int64_t x_min, x_max, y_min, y_max;
  std::int64_t frame_x, frame_y;  ///< upper corner of the frame
  int subtexel_bits;
  int size_exponent;  ///< triangles reach up to 2^size_exponent texels
  int uv_exponent;    ///< |uv| <= 2^uv_exponent
  int texture_width;  ///< of the first lookup; 1 where there is none
  int texture_height;
};

using Corners = std::array<RasterVertex, 3>;

/// The texel at which the generator aimed a tie; outside every frame where it aimed at none.
struct Aim {
  int i = -1, j = -1;
};

/// A triangle of a random category; `previous` is the one before, whose edge a "shared edge" triangle continues; `aim` is set.
[[nodiscard]] Corners random_triangle(Rng& rng, const TriangleDomain& domain, const Corners& previous, Aim& aim);

}  // namespace etalon::validation::reference
