// The picture of what is known of a stream's coefficients.
#pragma once

#include <vector>

#include "core/image/image.h"
#include "core/wavelet/band_state.h"
#include "core/wavelet/texture_stream.h"

namespace etalon::wavelet {

/// Every coefficient is taken at 3/8 of the interval it is known to lie in (at its value where all its bits are known, 5/3), those not yet
/// significant at 0; then the inverse transforms.
[[nodiscard]] Image reconstruct(const TextureHeader& header, const std::vector<BandState>& states);

}  // namespace etalon::wavelet
