// The form of the procedural head: a young crested dinosaur, looking toward +Z, +Y up, symmetric in x, about 2.9 units tall.
#pragma once

#include "core/procedural/tube_mesh.h"

namespace etalon::procedural {

struct HeadEye {
  Vec3d center;  ///< of the +x eyeball
  double radius;
  Vec3d axis;  ///< unit, where it looks
};
[[nodiscard]] const HeadEye& head_eye();

/// Signed-distance-like field of the whole head with its crest, lids, nostrils and mouth; negative inside.
[[nodiscard]] double head_field(const Vec3d& p);
/// Height of the mouth line at depth z.
[[nodiscard]] double mouth_height(double z);
/// 0 off the crest to 1 at its edge, and the phase of its scallops in turns.
struct CrestPlace {
  double rise;
  double phase;
};
[[nodiscard]] CrestPlace crest_place(const Vec3d& p);

/// Relative vertex density: the face matters most, the base least.
[[nodiscard]] double head_density(const Vec3d& p);
/// From the tip of the bill through the skull down to the base of the neck.
[[nodiscard]] SpinePose head_spine(double t);

}  // namespace etalon::procedural
