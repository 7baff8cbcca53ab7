// Which way three float32 points turn, decided exactly.
#pragma once

#include "core/math/vec.h"

namespace etalon {

/// Sign of the doubled area of (a, b, c): 1 counter-clockwise, −1 clockwise, 0 on a line. Exact for all finite float32: the six products
/// of two floats are doubles without rounding (48 bits, exponents −298..256), and their sum's sign is taken from an exact expansion
/// [Shewchuk 1997, sec. 2].
[[nodiscard]] int orientation(const Vec2f& a, const Vec2f& b, const Vec2f& c);

/// Whether the triangle has no area in space: its three coordinate projections are all on a line. Exact, as orientation().
[[nodiscard]] bool is_collinear(const Vec3f& a, const Vec3f& b, const Vec3f& c);

/// Twice the signed area in double, within 2^-50 of the sum of the six products' magnitudes; its sign is not to be trusted near 0.
[[nodiscard]] double doubled_area(const Vec2f& a, const Vec2f& b, const Vec2f& c);

}  // namespace etalon
