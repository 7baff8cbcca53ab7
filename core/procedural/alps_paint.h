// What an aircraft sees of the alps at noon.
#pragma once

#include "core/procedural/alps_ground.h"

namespace etalon::procedural {

/// RGB in [0, 1] at a place (AlpsGround's); `texel` is the side of a texel in cells.
[[nodiscard]] Vec3d alps_color(const AlpsGround& ground, double x, double y, double texel, std::uint64_t seed);

}  // namespace etalon::procedural
