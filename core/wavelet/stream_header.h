// The header of a texture stream as bytes, and what both sides derive from it.
#pragma once

#include <cstddef>
#include <vector>

#include "core/wavelet/band_state.h"
#include "core/wavelet/texture_stream.h"

namespace etalon::wavelet {

inline constexpr int kMinStepExponent = -6, kMaxStepExponent = 6;

[[nodiscard]] std::vector<std::byte> header_bytes(const TextureHeader& header);

/// InputError unless the delays are empty, or of this size and these levels.
void require_delays_fit(const Delays& delays, int width, int height, int levels);

/// Error in RGB of a unit of the coded integers, channel by channel, band by band: 5/3 codes coefficients as they are, 9/7 multiples of
/// quantisation_step(), which makes it the same for all.
[[nodiscard]] std::vector<double> coded_gains(const TextureHeader& header, const std::vector<Subband>& bands);
/// The bands of all channels with nothing known, as encoder and decoder begin.
[[nodiscard]] std::vector<BandState> fresh_states(const TextureHeader& header, const std::vector<Subband>& bands, const Delays& delays);
/// 9/7: what one unit of the coded integers is as a coefficient.
[[nodiscard]] double quantisation_step(const TextureHeader& header, const Subband& band, int channel);

}  // namespace etalon::wavelet
