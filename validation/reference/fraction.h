// Unreduced fractions and their one rounding: floor division to the lattice of representable numbers around the value.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/draw/state.h"
#include "validation/reference/big_number.h"

namespace etalon::validation::reference {

/// n / d, d > 0, not reduced.
struct Fraction {
  BigInt n = 0;
  BigInt d = 1;
};

/// The largest integer not above n / d, d > 0.
[[nodiscard]] BigInt floor_div(const BigInt& n, const BigInt& d);

/// A finite float32 as a fraction.
[[nodiscard]] Fraction exact(float value);

/// value · 2^bits, which must be an integer.
[[nodiscard]] BigInt fixed_point(float value, unsigned bits);

/// Nearest float32, ties to even, subnormals kept, overflow to infinity; whatever rounds to zero gives +0.
[[nodiscard]] float round_to_float32(const Fraction& value);
/// The float32 nearest to e / √square, e >= 0, square > 0; ties to even.
[[nodiscard]] float round_quotient_by_root(const BigInt& e, const BigInt& square);
/// Half bits; nearest: "from 65520 on → inf", toward zero: "truncated, from 65536 on → 65504".
[[nodiscard]] std::uint16_t round_to_half(const Fraction& value, HalfRounding rounding);
/// "unorm: clamp to [0, 1], then round(x·255) or round(x·65535)", nearest even; `steps` is 255 or 65535.
[[nodiscard]] std::uint32_t round_to_unorm(const Fraction& value, std::uint32_t steps);
/// "the byte is the number of thresholds T_1..T_255 with T_k ≤ x".
[[nodiscard]] std::uint32_t encode_srgb8(const Fraction& value);

/// Storage of channel `channel` of `format` at `texel` (the first byte of the texel); any type but uint32.
void store_channel(const Fraction& value, PixelFormat format, int channel, HalfRounding half_rounding, std::byte* texel);

}  // namespace etalon::validation::reference
