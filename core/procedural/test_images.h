// The two synthetic images that section 5 of [Soucy, Godin & Rioux 1996] lays over range images in place of surface colours.
#pragma once

#include "core/image/image.h"

namespace etalon::procedural {

/// Squares of 8 × 8 pixels, black and white, black at the corner of row 0 and column 0. RGB unorm8; sizes as of an Image.
[[nodiscard]] Image make_chessboard(int width = 256, int height = 256);

/// Red grows with the column and green with the row, from 0 to 255: round-half-up(255·i/(width − 1)) and so on; for 256 × 256 the column and
/// the row themselves. Blue is 0. RGB unorm8; a side of one pixel is 0.
[[nodiscard]] Image make_ramp(int width = 256, int height = 256);

}  // namespace etalon::procedural
