// Random numbers, images and states over the whole input range of docs/contract.md, with the places where rounding is hardest.
#pragma once

#include <cmath>
#include <memory>

#include "core/base/rng.h"
#include "core/draw/draw_list.h"

namespace etalon::validation::reference {

/// 2^e with e uniform in [lo, hi), times a uniform 24-bit mantissa in [1, 2) (exact scaling; the mantissa makes it log-uniform enough).
[[nodiscard]] inline float log_uniform(Rng& rng, int lo, int hi) {
  return std::ldexp(1.0f + static_cast<float>(rng.below(1u << 23)) * 0x1p-23f, static_cast<int>(rng.between(lo, hi - 1)));
}

template <class T>
[[nodiscard]] T one_of(Rng& rng, std::initializer_list<T> values) {
  return values.begin()[rng.below(values.size())];
}

/// True once in `n`.
[[nodiscard]] inline bool one_in(Rng& rng, std::uint64_t n) { return rng.below(n) == 0; }

/// An attribute with |a| <= 2^limit_exponent: colours in [0, 1], dyadic numbers, any magnitude, zeros, numbers around 2^-40.
[[nodiscard]] float random_attribute(Rng& rng, int limit_exponent);

/// Bits, fill rule, snap and half rounding, cull mode (mostly none), depth test: all values.
[[nodiscard]] RasterState random_state(Rng& rng);

/// A format that a shading may be stored in.
[[nodiscard]] PixelFormat random_format(Rng& rng, int channels);

[[nodiscard]] Sampler random_sampler(Rng& rng);

/// An image of 1..64 texels a side. Float and half texels have |t| <= 2^limit_exponent, those of one image in four include the tiny,
/// subnormal and negative zero.
[[nodiscard]] std::shared_ptr<const Image> random_image(Rng& rng, PixelFormat format, int limit_exponent);

}  // namespace etalon::validation::reference
