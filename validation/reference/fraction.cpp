#include "validation/reference/fraction.h"

#include <cmath>
#include <cstring>

#include "core/base/error.h"
#include "validation/reference/srgb_table.h"
#include "validation/reference/stored_number.h"

namespace etalon::validation::reference {

namespace {

// Sign of n / d − 2^e, n > 0.
int compare_with_power(const BigInt& n, const BigInt& d, int e) { return e >= 0 ? n.compare(BigInt(d << e)) : BigInt(n << -e).compare(d); }

// The e with 2^e <= n / d < 2^(e+1), n > 0.
int exponent_of(const BigInt& n, const BigInt& d) {
  int e = static_cast<int>(msb(n)) - static_cast<int>(msb(d));  // 2^(e-1) < n / d < 2^(e+1)
  if (compare_with_power(n, d, e) < 0) --e;
  return e;
}

// A binary floating-point number q · 2^e of `bits` bits with least exponent `min_exponent` (of the leading bit of a normal number).
struct Rounded {
  std::uint32_t q = 0;  // 0 .. 2^bits
  int e = 0;
};

// n >= 0. Within [2^k, 2^(k+1)) the representable numbers are the multiples of 2^(k−bits+1); below 2^min_exponent those of the
// least exponent. floor gives the neighbour below, the remainder says on which side of the middle the value lies.
Rounded round_magnitude(const BigInt& n, const BigInt& d, int bits, int min_exponent, bool toward_zero) {
  if (n == 0) return {};
  const int k = std::max(exponent_of(n, d), min_exponent);
  const int spacing = k - bits + 1;
  const BigInt numerator = spacing < 0 ? BigInt(n << -spacing) : n;
  const BigInt denominator = spacing > 0 ? BigInt(d << spacing) : d;
  BigInt q, r;
  divide_qr(numerator, denominator, q, r);
  const int side = BigInt(r << 1).compare(denominator);
  const bool up = !toward_zero && (side > 0 || (side == 0 && bit_test(q, 0)));
  return {q.convert_to<std::uint32_t>() + (up ? 1u : 0u), spacing};
}

}  // namespace

BigInt floor_div(const BigInt& n, const BigInt& d) {
  BigInt q, r;
  divide_qr(n, d, q, r);  // rounds toward zero; the remainder has the sign of n
  return r < 0 ? BigInt(q - 1) : q;
}

Fraction exact(float value) {
  const Binary b = binary_of_float32(value);
  return b.e >= 0 ? Fraction{BigInt(b.m) << b.e, 1} : Fraction{BigInt(b.m), BigInt(1) << -b.e};
}

BigInt fixed_point(float value, unsigned bits) {
  const Binary b = binary_of_float32(value);
  const int shift = b.e + static_cast<int>(bits);
  if (shift >= 0) return BigInt(b.m) << shift;
  const std::int64_t dropped = b.m & ((std::int64_t{1} << std::min(-shift, 62)) - 1);
  ETALON_CHECK(dropped == 0, "a number is finer than the contract's input range allows");
  return BigInt(-shift >= 62 ? 0 : b.m / (std::int64_t{1} << -shift));
}

float round_to_float32(const Fraction& value) {
  const Rounded rounded = round_magnitude(abs(value.n), value.d, 24, -126, false);
  const float magnitude = std::ldexp(static_cast<float>(rounded.q), rounded.e);
  if (magnitude == 0) return 0.0f;
  return value.n < 0 ? -magnitude : magnitude;
}

float round_quotient_by_root(const BigInt& e, const BigInt& square) {
  if (e == 0) return 0.0f;
  const BigInt e_squared = e * e;
  // 2^k <= e/√square < 2^(k+1) where 4^k <= e²/square < 4^(k+1).
  const int k2 = exponent_of(e_squared, square);
  const int k = (k2 - (k2 & 1)) / 2;
  const int spacing = k - 23;
  ETALON_CHECK(k >= -126 && k <= 127, "an edge distance left the range of float32");
  // q = floor(√(e² / (square · 4^spacing))): the root of the floor has the same floor as the root.
  const BigInt numerator = spacing < 0 ? BigInt(e_squared << (-2 * spacing)) : e_squared;
  const BigInt denominator = spacing > 0 ? BigInt(square << (2 * spacing)) : square;
  const BigInt q = sqrt(BigInt(numerator / denominator));
  // The middle is q + ½: compare 4·e² with (2q + 1)²·square, both at the scale of the spacing.
  const BigInt twice_middle = 2 * q + 1;
  const int side = BigInt(numerator << 2).compare(BigInt(twice_middle * twice_middle * denominator));
  const bool up = side > 0 || (side == 0 && bit_test(q, 0));
  return std::ldexp(static_cast<float>(q.convert_to<std::uint32_t>() + (up ? 1u : 0u)), spacing);
}

std::uint16_t round_to_half(const Fraction& value, HalfRounding rounding) {
  const BigInt magnitude = abs(value.n);
  const bool toward_zero = rounding == HalfRounding::toward_zero;
  std::uint32_t bits;
  if (toward_zero && magnitude >= 65536 * value.d) {
    bits = 0x7BFF;  // 65504
  } else if (!toward_zero && magnitude >= 65520 * value.d) {
    bits = 0x7C00;  // infinity
  } else {
    const Rounded r = round_magnitude(magnitude, value.d, 11, -14, toward_zero);
    // q · 2^e with 1024 <= q < 2048 is normal; the carry to q = 2048 and the subnormals fall into place in this encoding.
    bits = r.q == 0 ? 0 : (static_cast<std::uint32_t>(r.e + 24) << 10) + r.q;
  }
  return static_cast<std::uint16_t>(bits | (value.n < 0 && bits != 0 ? 0x8000u : 0u));
}

std::uint32_t round_to_unorm(const Fraction& value, std::uint32_t steps) {
  if (value.n <= 0) return 0;
  if (value.n >= value.d) return steps;
  BigInt q, r;
  divide_qr(BigInt(value.n * steps), value.d, q, r);
  const int side = BigInt(r << 1).compare(value.d);
  return q.convert_to<std::uint32_t>() + (side > 0 || (side == 0 && bit_test(q, 0)) ? 1u : 0u);
}

std::uint32_t encode_srgb8(const Fraction& value) {
  const auto& thresholds = srgb_thresholds();  // ascending, so the count is found by halving
  std::uint32_t below = 0, above = 255;        // thresholds[0 .. below) are <= x, thresholds[above ..] are > x
  while (below < above) {
    const std::uint32_t middle = (below + above) / 2;
    const Fraction t = exact(thresholds[middle]);
    if (t.n * value.d <= value.n * t.d)
      below = middle + 1;
    else
      above = middle;
  }
  return below;
}

void store_channel(const Fraction& value, PixelFormat format, int channel, HalfRounding half_rounding, std::byte* texel) {
  std::byte* const at = texel + channel * bytes_per_channel(format.type);
  const auto put = [at](auto stored) { std::memcpy(at, &stored, sizeof stored); };
  switch (format.type) {
    case ChannelType::unorm8: return put(static_cast<std::uint8_t>(round_to_unorm(value, 255)));
    case ChannelType::srgb8: return put(static_cast<std::uint8_t>(channel == 3 ? round_to_unorm(value, 255) : encode_srgb8(value)));
    case ChannelType::unorm16: return put(static_cast<std::uint16_t>(round_to_unorm(value, 65535)));
    case ChannelType::half: return put(round_to_half(value, half_rounding));
    case ChannelType::float32: return put(round_to_float32(value));
    case ChannelType::uint32: break;
  }
  throw_check_failed(__FILE__, __LINE__, "a number is stored in a format of numbers", to_string(format));
}

}  // namespace etalon::validation::reference
