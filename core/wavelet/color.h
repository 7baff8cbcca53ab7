// Texels to planes of coefficients' input and back: the colour transforms of JPEG 2000 with their level shift.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image/image.h"
#include "core/wavelet/lifting.h"

namespace etalon::wavelet {

/// Reversible colour transform: Y = ⌊(R + 2G + B)/4⌋, U = B − G, V = R − G [ISO 15444-1, G.2]; before it 128 is subtracted. One channel: that
/// only. unorm8 or srgb8 (the stored bytes are coded) of 1 or 3 channels; others are InputError.
[[nodiscard]] std::vector<Plane<std::int32_t>> reversible_planes(const Image& image);
/// Back, clamped to bytes; exact for the planes of reversible_planes().
[[nodiscard]] Image reversible_image(const std::vector<Plane<std::int32_t>>& planes, PixelFormat format);

/// Irreversible colour transform: Y = 0.299R + 0.587G + 0.114B, Cb, Cr [ISO 15444-1, G.3].
[[nodiscard]] std::vector<Plane<double>> irreversible_planes(const Image& image);
/// Back, rounded to the nearest byte (half up).
[[nodiscard]] Image irreversible_image(const std::vector<Plane<double>>& planes, PixelFormat format);

/// Euclidean norm in RGB of a unit error in channel c.
[[nodiscard]] double channel_norm(int channel, int channels, Kernel kernel);

}  // namespace etalon::wavelet
