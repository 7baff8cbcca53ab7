// The families of fixed_scenes() that are about numbers: what is looked up, interpolated and stored.
#pragma once

#include "validation/selftest/fixed_scenes.h"

namespace etalon::validation {

[[nodiscard]] SceneFamily shading_scenes();
[[nodiscard]] SceneFamily texture_scenes();
[[nodiscard]] SceneFamily wrap_scenes();
[[nodiscard]] SceneFamily extreme_value_scenes();
[[nodiscard]] SceneFamily target_scenes();

}  // namespace etalon::validation
