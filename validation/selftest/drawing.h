// One way to draw a scene; the bytes do not depend on it.
#pragma once

#include <string>

#include "raster/sample_values.h"
#include "raster/simd_level.h"

namespace etalon::validation {

/// How a scene is drawn: `level` counts for Evaluation::vectorised only.
struct Drawing {
  raster::Evaluation evaluation = raster::Evaluation::vectorised;
  raster::SimdLevel level = raster::SimdLevel::baseline;
  int threads = 1;
};

/// Makes the level and the thread count those of the process.
void apply(const Drawing& drawing);

/// "vectorised", "filtered", "exact".
[[nodiscard]] std::string to_string(raster::Evaluation evaluation);
/// The SIMD level's name; "-" where none is used.
[[nodiscard]] std::string level_name(const Drawing& drawing);

}  // namespace etalon::validation
