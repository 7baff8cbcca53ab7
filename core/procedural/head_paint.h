// The colours of the procedural head: pattern, eyes and the light baked over them.
#pragma once

#include "core/math/vec.h"

namespace etalon::procedural {

/// Light that is costly to trace and smooth enough to be kept per vertex.
struct HeadLight {
  double sky = 1;  ///< share of open sky, 0..1
  double key = 1;  ///< visibility of the key light, 0..1
};
[[nodiscard]] HeadLight head_light_at(const Vec3d& surface_point);

/// Display colour in [0, 1]³ of a point on (or near) the head's surface.
[[nodiscard]] Vec3d head_color(const Vec3d& near_surface, const HeadLight& light);

}  // namespace etalon::procedural
