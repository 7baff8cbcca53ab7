// Pictures for people: of any target, of its classes, of its errors. RGB unorm8, row 0 at the bottom like everything else.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "validation/texel_explainer.h"

namespace etalon::validation {

/// Colours that colour-blind readers can tell apart [Okabe & Ito 2008], red for what is wrong.
[[nodiscard]] std::array<std::uint8_t, 3> class_color(TexelClass value);

/// `image` as RGB bytes: unorm8/srgb8 as stored; unorm16, half and float32 clamped to [0, 1]; one float channel: grey, `low`..`high` to
/// white..black (nearer is brighter); ids: a colour from a hash, the clear value dark.
[[nodiscard]] Image picture_of(const Image& image, float low = 0, float high = 1);

/// Smallest and largest finite value of an R float32 image below 1 (the depth range of what was drawn); {0, 1} where nothing was.
struct ValueRange {
  float low = 0;
  float high = 1;
};
[[nodiscard]] ValueRange drawn_range(const Image& depth);

/// The picture in faint grey; texels of class rounding, which may be most of them, tinted; worse ones marked in full colour over
/// (2·reach + 1)² texels, so that a lone one is seen even after reduced(); where marks meet the worse class wins.
/// `classes`: R unorm8 of TexelClass values.
[[nodiscard]] Image class_picture(const Image& picture, const Image& classes, int reach = 1);

/// Dark where equal; over (2·reach + 1)² texels, from violet to yellow by log2 of the largest channel difference in stored units (floats: ulp; ids: yellow).
[[nodiscard]] Image error_picture(const Image& a, const Image& b, int reach = 1);

/// Every `step`-th texel of `picture`, so that no side exceeds `limit_px`; the picture itself where it fits.
[[nodiscard]] Image reduced(const Image& picture, int limit_px);

/// size × size texels centred on (x, y); mid grey outside.
[[nodiscard]] Image crop(const Image& picture, int x, int y, int size);

}  // namespace etalon::validation
