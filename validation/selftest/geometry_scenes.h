// The families of fixed_scenes() that are about decisions: which triangle, which texel, in which order.
#pragma once

#include "validation/selftest/fixed_scenes.h"

namespace etalon::validation {

[[nodiscard]] SceneFamily grid_scenes();
[[nodiscard]] SceneFamily far_scenes();
[[nodiscard]] SceneFamily tiny_scenes();
[[nodiscard]] SceneFamily sliver_scenes();
[[nodiscard]] SceneFamily tie_scenes();
[[nodiscard]] SceneFamily size_scenes();
[[nodiscard]] SceneFamily pass_scenes();

}  // namespace etalon::validation
