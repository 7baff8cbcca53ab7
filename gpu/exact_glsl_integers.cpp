#include "gpu/exact_glsl.h"

namespace etalon::gpu {

const std::string_view kGlslIntegers = R"(
// (-1)^negative · (q + r) · 2^e with 0 <= r < 1, and r > 0 where `more`. q >= 2^31, or q = 0 for the number 0.
struct Leading { bool negative; uint q; int e; bool more; };

// x · y in two words, by 16-bit halves: LLVM 15 was seen to crash on umulExtended of a factor of which it knows some bits.
void multiply_words(uint x, uint y, out uint high, out uint low) {
  uint x0 = x & 0xFFFFu, x1 = x >> 16, y0 = y & 0xFFFFu, y1 = y >> 16;
  uint p00 = x0 * y0;
  uint p10 = x1 * y0 + (p00 >> 16);
  uint p01 = x0 * y1 + (p10 & 0xFFFFu);
  low = (p01 << 16) | (p00 & 0xFFFFu);
  high = x1 * y1 + (p10 >> 16) + (p01 >> 16);
}

void multiply(inout uint product[5], uint factor) {
  uint carry = 0u;
  for (int i = 0; i < 5; ++i) {
    uint high, low;
    multiply_words(product[i], factor, high, low);
    low += carry;
    carry = high + uint(low < carry);
    product[i] = low;
  }
}

// sum += (-1)^negative · product · 2^shift, 0 <= shift < 32 · LIMBS.
void add_shifted(inout uint sum[LIMBS], uint product[5], int shift, bool negative) {
  uint v[LIMBS];
  int bits = shift & 31;
  uint below = 0u;
  for (int i = 0; i < LIMBS; ++i) {
    uint limb = i < 5 ? product[min(i, 4)] : 0u;
    v[i] = (limb << bits) | ((below >> 1) >> (31 - bits));
    below = limb;
  }
  for (int step = HALF_LIMBS; step > 0; step >>= 1) {
    bool moves = ((shift >> 5) & step) != 0;
    for (int i = LIMBS - 1; i >= 0; --i) {
      uint moved = i >= step ? v[max(i - step, 0)] : 0u;
      v[i] = moves ? moved : v[i];
    }
  }
  uint carry = uint(negative);
  uint flip = negative ? 0xFFFFFFFFu : 0u;
  for (int i = 0; i < LIMBS; ++i) {
    uint x = v[i] ^ flip;
    uint once = sum[i] + x;
    uint twice = once + carry;
    carry = uint(once < x) | uint(twice < once);
    sum[i] = twice;
  }
}

// Shifts a number that is not 0 left until its highest bit is the array's; returns its bit length before.
int normalise(inout uint a[LIMBS]) {
  int length = 32 * LIMBS;
  for (int step = HALF_LIMBS; step > 0; step >>= 1) {
    uint top = 0u;
    for (int i = LIMBS - step; i < LIMBS; ++i) top |= a[i];
    bool moves = top == 0u;
    for (int i = LIMBS - 1; i >= 0; --i) {
      uint moved = i >= step ? a[max(i - step, 0)] : 0u;
      a[i] = moves ? moved : a[i];
    }
    length -= moves ? 32 * step : 0;
  }
  int bits = 31 - findMSB(a[LIMBS - 1]);
  for (int i = LIMBS - 1; i >= 0; --i) {
    uint below = i > 0 ? a[max(i - 1, 0)] : 0u;
    a[i] = (a[i] << bits) | ((below >> 1) >> (31 - bits));
  }
  return length - bits;
}

// n / d, d > 0: 32 steps of long division.
Leading divide(uint n[LIMBS], uint d[LIMBS]) {
  Leading result = Leading((n[LIMBS - 1] >> 31) != 0u, 0u, 0, false);
  uint any = 0u;
  uint carry = uint(result.negative);
  uint flip = result.negative ? 0xFFFFFFFFu : 0u;
  for (int i = 0; i < LIMBS; ++i) {
    uint flipped = n[i] ^ flip;
    n[i] = flipped + carry;
    carry = uint(n[i] < flipped);
    any |= n[i];
  }
  if (any == 0u) return result;
  result.e = normalise(n) - normalise(d) - 31;
  uint over = 0u;  // the bit above the array
  for (int round = 0; round < 33; ++round) {
    uint rest[LIMBS];
    uint borrow = 0u;
    for (int i = 0; i < LIMBS; ++i) {
      uint once = n[i] - d[i];
      uint twice = once - borrow;
      borrow = uint(n[i] < d[i]) | uint(once < borrow);
      rest[i] = twice;
    }
    bool fits = over != 0u || borrow == 0u;
    // n/d is in (1/2, 2): where the first digit is 0, one more makes 32 leading digits; else 32 are there one round earlier.
    bool done = round == 32 && result.q >= 0x80000000u;
    if (!done) {
      if (round == 32) --result.e;
      result.q = (result.q << 1) | uint(fits);
      uint below = 0u;
      for (int i = 0; i < LIMBS; ++i) {
        uint x = fits ? rest[i] : n[i];
        n[i] = (x << 1) | below;
        below = x >> 31;
      }
      over = below;
    }
  }
  any = over;
  for (int i = 0; i < LIMBS; ++i) any |= n[i];
  result.more = any != 0u;
  return result;
}
)";

}  // namespace etalon::gpu
