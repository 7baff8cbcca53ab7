// The sRGB tables of docs/contract.md#srgb, computed from the curve with integers alone (x^2.4 = y exactly when x^12 = y^5).
#pragma once

#include <array>

#include "validation/reference/fraction.h"

namespace etalon::validation::reference {

/// decode[i]: the float32 nearest to the IEC 61966-2-1 curve at i/255.
[[nodiscard]] const std::array<float, 256>& srgb_decode();

/// thresholds[k − 1] = T_k: the smallest float32 not below the curve's value at (k − ½)/255, k = 1..255; ascending.
[[nodiscard]] const std::array<float, 255>& srgb_thresholds();

/// Sign of curve(numerator/denominator) − y, exact; the argument in [0, 1], y >= 0.
/// The curve: x / 12.92 where x <= 0.04045, else ((x + 0.055) / 1.055)^2.4 [IEC 61966-2-1:1999].
[[nodiscard]] int compare_srgb_curve(int numerator, int denominator, const Fraction& y);

}  // namespace etalon::validation::reference
