// Five range images as of the NRCC's range sensor [Soucy, Godin & Rioux 1996, section 5; Rioux & Cournoyer 1988]: a space shuttle replica, a
// hand, a toy soldier, a teapot, a telephone; 15 to 20 cm long. The papers' own data are not to be had; these have what they need:
// smooth parts, creases, jumps in depth between parts, a sensor's noise, and no background.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "core/mesh/range_image.h"

namespace etalon::procedural {

enum class RangeKind : std::uint8_t { shuttle, hand, soldier, teapot, telephone };

/// All kinds, in the order of the paper.
[[nodiscard]] std::span<const RangeKind> range_kinds();
[[nodiscard]] std::string_view range_name(RangeKind kind);

/// Depths are multiples of this many millimetres: a 16-bit file holds them exactly.
inline constexpr double kRangeStep = 1.0 / 256;

/// 256 × 256 samples in millimetres, seen along −z with y up. Depths are above 0 and below 128 mm, multiples of kRangeStep, and carry noise
/// of about 0.03 mm (standard deviation); surfaces seen at a cosine below 0.1 (84°) and the background give no sample. Equal bytes for any
/// thread count and compiler.
[[nodiscard]] RangeImage make_range_scan(RangeKind kind);

}  // namespace etalon::procedural
