// How large the numbers of an image are.
#pragma once

#include <array>

#include "core/image/image.h"

namespace etalon {

/// Largest magnitude in each channel of a half or float32 image, on all threads; +inf where a channel holds NaN. Bounded formats have 1, and
/// so have absent channels of theirs; absent channels of the others have 0.
using ChannelMaxima = std::array<double, 4>;
[[nodiscard]] ChannelMaxima channel_maxima(const Image& image);

}  // namespace etalon
