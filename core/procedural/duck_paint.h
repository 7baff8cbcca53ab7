// The plumage of the procedural duck.
#pragma once

#include "core/math/vec.h"

namespace etalon::procedural {

/// Display colour in [0, 1]³ of a point on the surface, light included.
[[nodiscard]] Vec3d duck_color(const Vec3d& surface_point);

}  // namespace etalon::procedural
