// Small pictures for the tests of wavelets and their streams.
#pragma once

#include "core/image/image.h"

namespace etalon::test {

/// Bytes by chance: the worst that a coder can meet.
[[nodiscard]] Image noise_texture(int width, int height, PixelFormat format, std::uint64_t seed);

/// Soft hills in three colours with a sharp border between them: most coefficients are small.
[[nodiscard]] Image landscape_texture(int width, int height, PixelFormat format = kRgb8);

/// Sum of squared differences of all bytes.
[[nodiscard]] std::uint64_t squared_error(const Image& a, const Image& b);

}  // namespace etalon::test
