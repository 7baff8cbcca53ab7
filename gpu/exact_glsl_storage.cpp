#include "gpu/exact_glsl.h"

namespace etalon::gpu {

const std::string_view kGlslBits = R"(
// float32 nearest to x, ties to even; below 2^-126 only numbers that are float32 themselves are kept right. +0 for a zero.
uint float_bits(double x) {
  uvec2 word = unpackDouble2x32(x);
  uint sign = word.y & 0x80000000u;
  uint high = word.y & 0x7FFFFFFFu;
  int e = int(high >> 20) - 1023;
  uint m = ((high & 0x000FFFFFu) << 3) | (word.x >> 29);
  uint rest = word.x & 0x1FFFFFFFu;
  uint up = uint(rest > 0x10000000u || (rest == 0x10000000u && (m & 1u) != 0u));
  if (e >= -126) return sign | ((uint(e + 127) << 23) + m + up);
  int places = -126 - e;
  uint subnormal = places > 23 ? 0u : (m | 0x00800000u) >> min(places, 31);
  return subnormal == 0u ? 0u : sign | subnormal;
}

double float_number(uint bits) {
  uint e = (bits >> 23) & 0xFFu, m = bits & 0x007FFFFFu;
  if (e == 0u) {
    double magnitude = double(m) * packDouble2x32(uvec2(0u, uint(1023 - 149) << 20));
    return (bits >> 31) != 0u ? -magnitude : magnitude;
  }
  return packDouble2x32(uvec2(m << 29, (bits & 0x80000000u) | ((e + 896u) << 20) | (m >> 3)));
}

// The contract's view of small numbers where an image is filtered: below 2^-40 they count as 0.
uint canonical_bits(uint bits) { return (bits & 0x7FFFFFFFu) < uint(127 - 40) << 23 ? 0u : bits; }

// (-1)^negative · m · 2^e, m < 2^24.
struct Parts { uint m; int e; bool negative; };

Parts float_parts(uint bits) {
  uint e = (bits >> 23) & 0xFFu, m = bits & 0x007FFFFFu;
  return Parts(e == 0u ? m : m | 0x00800000u, int(max(e, 1u)) - 150, (bits >> 31) != 0u);
}

Parts half_parts(uint bits) {
  uint e = (bits >> 10) & 0x1Fu, m = bits & 0x3FFu;
  return Parts(e == 0u ? m : m | 0x400u, int(max(e, 1u)) - 25, (bits & 0x8000u) != 0u);
}

double half_number(uint bits) {
  uint e = (bits >> 10) & 0x1Fu, m = bits & 0x3FFu;
  if (e == 0u) {
    double magnitude = double(m) * packDouble2x32(uvec2(0u, uint(1023 - 24) << 20));
    return (bits & 0x8000u) != 0u ? -magnitude : magnitude;
  }
  return packDouble2x32(uvec2(0u, ((bits & 0x8000u) << 16) | ((e + 1008u) << 20) | (m << 10)));
}
)";

const std::string_view kGlslFloat32 = R"(
bool try_float32(double lo, double hi, out uint code) {
  code = 0u;
  if (lo == 0.0lf && hi == 0.0lf) return true;
  code = float_bits(lo);
  const double normal = packDouble2x32(uvec2(0u, uint(1023 - 126) << 20));
  return code == float_bits(hi) && abs(lo) >= normal && abs(hi) >= normal;
}

uint float32_code(Leading v) {
  if (v.q == 0u) return 0u;
  int e = v.e + 31;
  int places = e >= -126 ? 8 : 8 - 126 - e;
  if (places > 32) return 0u;
  uint m = places == 32 ? 0u : v.q >> places;
  uint rest = v.q << (32 - places);
  bool up = rest > 0x80000000u || (rest == 0x80000000u && (v.more || (m & 1u) != 0u));
  uint magnitude = (e >= -126 ? uint(e + 126) << 23 : 0u) + m + uint(up);
  return magnitude == 0u ? 0u : (v.negative ? 0x80000000u : 0u) | magnitude;
}
)";

const std::string_view kGlslStoreFloat32 = R"(
uint store_scale(bool alpha) { return 1u; }
bool try_store(double lo, double hi, bool alpha, out uint code) { return try_float32(lo, hi, code); }
uint code_of(double x, bool alpha) { return float_bits(x); }
uint code_of(Leading v, bool alpha) { return float32_code(v); }
)";

const std::string_view kGlslStoreHalf = R"(
uint store_scale(bool alpha) { return 1u; }

// e: exponent of the leading bit; m: 32 bits from it on, the first 1; more: anything beyond.
uint half_code(bool negative, int e, uint m, bool more) {
  if (e > 15) return (negative ? 0x8000u : 0u) | (toward_zero ? 0x7BFFu : 0x7C00u);
  int places = e >= -14 ? 21 : 21 - 14 - e;
  if (places > 32) return 0u;
  uint kept = places == 32 ? 0u : m >> places;
  uint rest = m << (32 - places);
  bool up = !toward_zero && (rest > 0x80000000u || (rest == 0x80000000u && (more || (kept & 1u) != 0u)));
  uint magnitude = (e >= -14 ? uint(e + 14) << 10 : 0u) + kept + uint(up);
  return magnitude == 0u ? 0u : (negative ? 0x8000u : 0u) | magnitude;
}

uint code_of(double x, bool alpha) {
  uvec2 word = unpackDouble2x32(x);
  uint high = word.y & 0x7FFFFFFFu;
  if ((high >> 20) == 0u) return 0u;
  return half_code((word.y >> 31) != 0u, int(high >> 20) - 1023, 0x80000000u | ((high & 0x000FFFFFu) << 11) | (word.x >> 21),
                   (word.x & 0x001FFFFFu) != 0u);
}

uint code_of(Leading v, bool alpha) { return v.q == 0u ? 0u : half_code(v.negative, v.e + 31, v.q, v.more); }

bool try_store(double lo, double hi, bool alpha, out uint code) {
  code = code_of(lo, alpha);
  return code == code_of(hi, alpha);
}
)";

const std::string_view kGlslUnorm = R"(
bool try_unorm(double lo, double hi, out uint code) {
  const double slack = packDouble2x32(uvec2(0u, uint(1023 - 34) << 20));
  precise double below = clamp(lo, 0.0lf, 1.0lf) * double(SCALE) + 0.5lf - slack;
  precise double above = clamp(hi, 0.0lf, 1.0lf) * double(SCALE) + 0.5lf + slack;
  code = uint(max(below, 0.0lf));
  return code == uint(above);
}

// x · SCALE is exact, or further from a tie than its rounding.
uint unorm_code(double x) {
  precise double scaled = clamp(x, 0.0lf, 1.0lf) * double(SCALE);
  uint whole = uint(scaled);
  precise double rest = scaled - double(whole);
  return whole + uint(rest > 0.5lf || (rest == 0.5lf && (whole & 1u) != 0u));
}

// The number times SCALE.
uint unorm_code(Leading v) {
  if (v.q == 0u || v.negative) return 0u;
  int places = -v.e;
  if (places > 32) return 0u;
  if (places < 15) return SCALE;
  uint whole = places == 32 ? 0u : v.q >> places;
  uint rest = v.q << (32 - places);
  bool up = rest > 0x80000000u || (rest == 0x80000000u && (v.more || (whole & 1u) != 0u));
  return min(whole + uint(up), SCALE);
}
)";

const std::string_view kGlslStoreUnorm = R"(
uint store_scale(bool alpha) { return SCALE; }
bool try_store(double lo, double hi, bool alpha, out uint code) { return try_unorm(lo, hi, code); }
uint code_of(double x, bool alpha) { return unorm_code(x); }
uint code_of(Leading v, bool alpha) { return unorm_code(v); }
)";

const std::string_view kGlslStoreSrgb = R"(
uint threshold(uint k) { return texelFetch(tables, ivec2(int(k) - 1, 1), 0).r; }

// How many of the thresholds T_1 .. T_255, positive float32 in order, the number of these bits has reached.
uint reached(uint positive_bits) {
  uint count = 0u;
  for (uint step = 128u; step > 0u; step >>= 1) count += threshold(count + step) <= positive_bits ? step : 0u;
  return count;
}

// float32 bits of a number cut off towards zero: reaches the same thresholds. 0 for what is below 2^-126.
uint cut(double x) {
  uvec2 word = unpackDouble2x32(x);
  int e = int(word.y >> 20) - 1023;
  if (x <= 0.0lf || e < -126) return 0u;
  return e > 126 ? 0x7F000000u : (uint(e + 127) << 23) | ((word.y & 0x000FFFFFu) << 3) | (word.x >> 29);
}
uint cut(Leading v) {
  int e = v.e + 31;
  if (v.q == 0u || v.negative || e < -126) return 0u;
  return e > 126 ? 0x7F000000u : (uint(e + 126) << 23) + (v.q >> 8);
}

uint store_scale(bool alpha) { return alpha ? 255u : 1u; }

bool try_store(double lo, double hi, bool alpha, out uint code) {
  if (alpha) return try_unorm(lo, hi, code);
  code = reached(cut(lo));
  return code == reached(cut(hi));
}
uint code_of(double x, bool alpha) { return alpha ? unorm_code(x) : reached(cut(x)); }
uint code_of(Leading v, bool alpha) { return alpha ? unorm_code(v) : reached(cut(v)); }
)";

}  // namespace etalon::gpu
