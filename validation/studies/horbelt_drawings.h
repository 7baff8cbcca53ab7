// Figures 4 and 5 of [Horbelt, Balmelli & Vetterli] as SVG.
#pragma once

#include <string>

#include "validation/studies/horbelt_study.h"

namespace etalon::validation {

/// Figure 4: PSNR over bits, a thin line for each texture over all its meshes, the staircase of all pairs bold, the path of slope between them.
[[nodiscard]] std::string rate_drawing(const HorbeltViewResult& view);

/// Figure 5: lines of equal PSNR over the levels of mesh (across) and texture (up), the pairs of the staircase bold, the path of slope thin.
[[nodiscard]] std::string iso_drawing(const HorbeltViewResult& view);

}  // namespace etalon::validation
