// The form of the procedural duck, symmetric in x.
#pragma once

#include "core/procedural/tube_mesh.h"

namespace etalon::procedural {

/// Signed-distance-like; negative inside.
[[nodiscard]] double duck_field(const Vec3d& p);

/// From the tip of the bill (t = 0) through head, neck and body to the tail (t = 1).
[[nodiscard]] SpinePose duck_spine(double t);

struct DuckEye {
  Vec3d center;  ///< of the +x eye
  double radius;
};
[[nodiscard]] const DuckEye& duck_eye();

/// Distance to the folded wing's outline seen from the side; negative inside.
[[nodiscard]] double duck_wing(const Vec3d& p);

}  // namespace etalon::procedural
