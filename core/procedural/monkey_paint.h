// The colours of the procedural monkey.
#pragma once

#include "core/math/vec.h"

namespace etalon::procedural {

/// Display colour in [0, 1]³ of a point on the surface, light included.
[[nodiscard]] Vec3d monkey_color(const Vec3d& surface_point);

}  // namespace etalon::procedural
