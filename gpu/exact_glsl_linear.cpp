#include "gpu/exact_glsl.h"

namespace etalon::gpu {

const std::string_view kGlslLinear = R"(
// x = u · size − 1/2 along one axis: floor(x), and an interval that holds x − floor(x).
struct Axis { int index; double lo; double hi; };

double power(int e) { return packDouble2x32(uvec2(0u, uint(1023 + e) << 20)); }

// False where doubles cannot decide the floor.
bool try_axis(uvec3 bits, int size, out Axis axis) {
  double lo, hi;
  enclose(bits, lo, hi);
  precise double lowest = lo * double(size) - 0.5lf, highest = hi * double(size) - 0.5lf;
  axis.index = floor_of(lowest);
  precise double slack = power(-51) * (abs(lowest) + 1.0lf);
  precise double below = lowest - double(axis.index) - slack, above = highest - double(axis.index) + slack;
  axis.lo = below;
  axis.hi = above;
  return axis.index == floor_of(highest);
}

// u is a float32: the product is exact, and so is the floor of the rounded difference.
Axis stored_axis(double u, int size) {
  precise double x = u * double(size) - 0.5lf;
  int index = floor_of(x);
  precise double f = x - double(index);
  return Axis(index, f - power(-51), f + power(-51));
}

// u is raw / denominator, raw <= denominator <= 65535, size <= 2^15.
Axis stored_axis(uint raw, uint denominator, int size) {
  uint twice = 2u * raw * uint(size);
  int index = twice < denominator ? -1 : int((twice - denominator) / (2u * denominator));
  precise double f = (double(twice) - (2.0lf * double(index) + 1.0lf) * double(denominator)) / (2.0lf * double(denominator));
  return Axis(index, f - power(-51), f + power(-51));
}

// The texels t00, t10, t01, t11 weighted.
void enclose_linear(Axis u, Axis v, dvec4 t, out double lo, out double hi) {
  precise double f = 0.5lf * (u.lo + u.hi), df = 0.5lf * (u.hi - u.lo);
  precise double g = 0.5lf * (v.lo + v.hi), dg = 0.5lf * (v.hi - v.lo);
  precise double value = (1.0lf - g) * ((1.0lf - f) * t.x + f * t.y) + g * ((1.0lf - f) * t.z + f * t.w);
  double largest = max(max(abs(t.x), abs(t.y)), max(abs(t.z), abs(t.w)));
  precise double error = largest * (2.0lf * (df + dg) + power(-48));
  precise double below = value - error, above = value + error;
  lo = below;
  hi = above;
}
)";

const std::string_view kGlslExactLinear = R"(
const int kPart = 8;  // words of a fraction's integers: below 2^238

void shift_left(inout uint a[LIMBS], int shift) {
  int bits = shift & 31;
  for (int i = LIMBS - 1; i >= 0; --i) {
    uint below = i > 0 ? a[max(i - 1, 0)] : 0u;
    a[i] = (a[i] << bits) | ((below >> 1) >> (31 - bits));
  }
  for (int step = HALF_LIMBS; step > 0; step >>= 1) {
    bool moves = ((shift >> 5) & step) != 0;
    for (int i = LIMBS - 1; i >= 0; --i) {
      uint moved = i >= step ? a[max(i - step, 0)] : 0u;
      a[i] = moves ? moved : a[i];
    }
  }
}

void multiply_by(inout uint a[LIMBS], uint factor) {
  uint carry = 0u;
  for (int i = 0; i < LIMBS; ++i) {
    uint high, low;
    multiply_words(a[i], factor, high, low);
    low += carry;
    carry = high + uint(low < carry);
    a[i] = low;
  }
}

// a += (-1)^negative · b
void add(inout uint a[LIMBS], uint b[LIMBS], bool negative) {
  uint carry = uint(negative);
  uint flip = negative ? 0xFFFFFFFFu : 0u;
  for (int i = 0; i < LIMBS; ++i) {
    uint x = b[i] ^ flip;
    uint once = a[i] + x;
    uint twice = once + carry;
    carry = uint(once < x) | uint(twice < once);
    a[i] = twice;
  }
}

void product_of(uint a[kPart], uint b[kPart], out uint result[LIMBS]) {
  for (int i = 0; i < LIMBS; ++i) result[i] = 0u;
  for (int i = 0; i < kPart; ++i) {
    uint carry = 0u;
    for (int j = 0; j < kPart; ++j) {
      uint high, low;
      multiply_words(a[i], b[j], high, low);
      low += carry;
      carry = high + uint(low < carry);
      low += result[i + j];
      carry += uint(low < result[i + j]);
      result[i + j] = low;
    }
    result[i + kPart] = carry;
  }
}

// x = u · size − 1/2 along one axis: floor(x), and x − floor(x) = part / whole.
struct ExactAxis { int index; uint part[kPart]; uint whole[kPart]; };

// 2 · u · size = n · 2^least / d.
ExactAxis axis_of(int least, uint n[LIMBS], uint d[LIMBS]) {
  shift_left(d, max(-least, 0));
  shift_left(n, max(least, 0));
  add(n, d, true);
  shift_left(d, 1);
  ExactAxis axis;
  axis.index = floor_of(divide(n, d));
  uint whole_part[LIMBS] = d;
  multiply_by(whole_part, uint(abs(axis.index)));
  add(n, whole_part, axis.index > 0);
  for (int i = 0; i < kPart; ++i) {
    axis.part[i] = n[i];
    axis.whole[i] = d[i];
  }
  return axis;
}

ExactAxis exact_axis(uvec3 bits, int size) {
  uint n[LIMBS], d[LIMBS];
  int least = exact_sums(bits, 2u * uint(size), n, d);
  return axis_of(least, n, d);
}

// u is a stored number.
ExactAxis exact_stored_axis(Parts u, uint denominator, int size) {
  uint n[LIMBS], d[LIMBS], product[LIMBS];
  for (int i = 0; i < LIMBS; ++i) n[i] = d[i] = product[i] = 0u;
  product[0] = u.m;
  multiply_by(product, 2u * uint(size));
  add(n, product, u.negative);
  d[0] = denominator;
  return axis_of(u.e, n, d);
}

uint[kPart] complement_of(ExactAxis axis) {
  uint result[kPart];
  uint borrow = 0u;
  for (int i = 0; i < kPart; ++i) {
    uint once = axis.whole[i] - axis.part[i];
    uint twice = once - borrow;
    borrow = uint(axis.whole[i] < axis.part[i]) | uint(once < borrow);
    result[i] = twice;
  }
  return result;
}

// The texels t00, t10, t01, t11 over one denominator, weighted, times scale.
Leading exact_linear(ExactAxis u, ExactAxis v, Parts t[4], uint denominator, uint scale) {
  int least = 1000;
  for (int k = 0; k < 4; ++k) least = t[k].m != 0u ? min(least, t[k].e) : least;
  uint n[LIMBS], d[LIMBS];
  for (int i = 0; i < LIMBS; ++i) n[i] = 0u;
  uint u_rest[kPart] = complement_of(u), v_rest[kPart] = complement_of(v);
  for (int k = 0; k < 4; ++k) {
    uint a[kPart], b[kPart];
    for (int i = 0; i < kPart; ++i) {
      a[i] = (k & 1) != 0 ? u.part[i] : u_rest[i];
      b[i] = (k & 2) != 0 ? v.part[i] : v_rest[i];
    }
    uint term[LIMBS];
    product_of(a, b, term);
    multiply_by(term, t[k].m);
    multiply_by(term, scale);
    shift_left(term, t[k].m == 0u ? 0 : t[k].e - least);
    add(n, term, t[k].negative);
  }
  product_of(u.whole, v.whole, d);
  multiply_by(d, denominator);
  Leading result = divide(n, d);
  result.e += least == 1000 ? 0 : least;
  return result;
}
)";

}  // namespace etalon::gpu
