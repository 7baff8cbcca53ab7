// The form of the procedural monkey: a mandrill's head on its neck, symmetric in x.
#pragma once

#include "core/procedural/implicit.h"

namespace etalon::procedural {

struct MonkeyEye {
  Vec3d center;  ///< of the +x eyeball
  double radius;
  Vec3d axis;  ///< unit, where it looks
};
[[nodiscard]] const MonkeyEye& monkey_eye();

/// Signed-distance-like; negative inside.
[[nodiscard]] double monkey_field(const Vec3d& p);

/// Height of the mouth line at |x|.
[[nodiscard]] double monkey_mouth(double x);

/// Where the bare face gives way to fur: 1 on the skin, 0 in the fur.
[[nodiscard]] double monkey_face(const Vec3d& p);
/// 1 inside the cup of an ear.
[[nodiscard]] double monkey_ear_cup(const Vec3d& p);

}  // namespace etalon::procedural
