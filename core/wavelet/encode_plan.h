// All that an encoder knows before its first bit: the integers it will send and the order of its passes.
#pragma once

#include <cstddef>
#include <vector>

#include "core/image/image.h"
#include "core/wavelet/band_state.h"
#include "core/wavelet/plane_coder.h"
#include "core/wavelet/texture_stream.h"

namespace etalon::wavelet {

struct EncodePlan {
  TextureHeader header;
  std::vector<Subband> bands;
  std::vector<BandTruth> truths;  ///< channel by channel, band by band
  std::vector<BandState> states;  ///< with top_plane set
  std::vector<Pass> passes;
  std::size_t significant_total = 0;  ///< coefficients that are not 0, without those that are never sent
};

/// Checks the options (InputError), transforms the image, quantises.
[[nodiscard]] EncodePlan plan_encoding(const Image& image, const EncodeOptions& options);

}  // namespace etalon::wavelet
