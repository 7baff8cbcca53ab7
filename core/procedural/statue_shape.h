// The form of the procedural statue: a standing figure with joined hands, its veil and robe in folds, on a stepped plinth.
#pragma once

#include "core/procedural/implicit.h"

namespace etalon::procedural {

/// Signed-distance-like; negative inside.
[[nodiscard]] double statue_field(const Vec3d& p);

/// What a point near the surface belongs to.
enum class StatuePart { plinth, robe, veil, skin, hair };
[[nodiscard]] StatuePart statue_part(const Vec3d& p);

/// Height at which the robe's hem, the veil's edge and the sleeves' cuffs run: signed distance to the nearest of these borders along its cloth.
[[nodiscard]] double statue_border(const Vec3d& p, StatuePart part);

}  // namespace etalon::procedural
