// Rationals from stored bits, and their rounding by bisection over the bit patterns of the format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "core/draw/state.h"
#include "validation/reference/big_number.h"

namespace etalon::validation::reference {

/// A finite float32, a finite half.
[[nodiscard]] BigRational rational_of_float32(float value);
[[nodiscard]] BigRational rational_of_half(std::uint16_t bits);

/// The largest integer not above q.
[[nodiscard]] BigRational floor_of(const BigRational& q);

/// The float32 nearest to a number x >= 0 that is known only by comparison: `compare(y)` is the sign of x − y.
[[nodiscard]] float nearest_float32(const std::function<int(const BigRational&)>& compare);
/// The float32 nearest to q, ties to even; whatever rounds to zero gives +0.
[[nodiscard]] float nearest_float32(const BigRational& q);

/// Storage of channel `channel` of `format` at `texel` (the first byte of the texel); any type but uint32.
void store_rational(const BigRational& value, PixelFormat format, int channel, HalfRounding half_rounding, std::byte* texel);

}  // namespace etalon::validation::reference
