// Indexing maps and stand-in textures for the scenes of `verify`.
#pragma once

#include <memory>

#include "core/image/image.h"

namespace etalon::validation {

/// RG float32: texel (i, j) holds its own centre, turned about (½, ½) by 0.4·(1 − 4r²)² turns at distance r < ½: a swirl without folds.
[[nodiscard]] std::shared_ptr<const Image> swirled_map(int width, int height);

/// RG unorm16: texel (i, j) holds its own centre ((i + ½)/width, (j + ½)/height), rounded to nearest even. Up to 8192 a side nearest
/// lookups through it name every texel of a texture of this size.
[[nodiscard]] std::shared_ptr<const Image> identity_map(int width, int height);

/// RGB unorm8, 256 × 256: a checkerboard of 16 × 16 fields whose hue runs with u and v, so that a flip or a shift can be seen.
[[nodiscard]] std::shared_ptr<const Image> checkerboard();

}  // namespace etalon::validation
