#include "gpu/exact_glsl.h"

namespace etalon::gpu {

const std::string_view kGlslNumbers = R"(
ivec2 corner[3];    // sub-texels
uint corner_w[3];   // bits of float32
bool affine;
bool clockwise;
// Half the width of an enclosure, relative to the largest number in it: 2^-49.
const double kEnclosure = packDouble2x32(uvec2(0u, uint(1023 - 49) << 20));

double edge[3];     // E_i >= 0 inside; integers below 2^45, so every operation on them is exact
double area;
double weight[3];   // E_i · w_j · w_k, within 2^-53
double weight_sum;  // within 3 · 2^-53

ivec2 texel;        // of the frame

ivec2 sample_position() { return (2 * texel + 1) << (subtexel_bits - 1); }

// The edge functions at the sample; texel and corner[] are set.
void set_edges() {
  ivec2 s = sample_position();
  precise double sum = 0.0lf;
  for (int i = 0; i < 3; ++i) {
    ivec2 a = corner[(i + 1) % 3];
    ivec2 d = corner[(i + 2) % 3] - a;
    ivec2 p = s - a;
    precise double e = double(d.x) * double(p.y) - double(d.y) * double(p.x);
    edge[i] = e;
    sum += e;
  }
  clockwise = sum < 0.0lf;
  if (clockwise) {
    for (int i = 0; i < 3; ++i) edge[i] = -edge[i];
    sum = -sum;
  }
  area = sum;
}

// corner_w[] and edge[] are set.
void set_weights() {
  affine = corner_w[0] == corner_w[1] && corner_w[1] == corner_w[2];
  for (int i = 0; i < 3; ++i) {
    precise double w = edge[i];
    if (!affine) w = edge[i] * (double(uintBitsToFloat(corner_w[(i + 1) % 3])) * double(uintBitsToFloat(corner_w[(i + 2) % 3])));
    weight[i] = w;
  }
  precise double sum = (weight[0] + weight[1]) + weight[2];
  weight_sum = sum;
}

// An attribute's three float32 bits; the number lies in [lo, hi].
void enclose(uvec3 bits, out double lo, out double hi) {
  dvec3 a = dvec3(uintBitsToFloat(bits));
  precise double n = (weight[0] * a.x + weight[1] * a.y) + weight[2] * a.z;
  precise double value = n / weight_sum;
  precise double error = max(max(abs(a.x), abs(a.y)), abs(a.z)) * kEnclosure;
  precise double below = value - error, above = value + error;
  lo = below;
  hi = above;
}

void enclose_barycentric(int i, out double lo, out double hi) {
  precise double value = weight[i] / weight_sum;
  precise double error = value * kEnclosure;
  precise double below = value - error, above = value + error;
  lo = below;
  hi = above;
}

// float32 bits of a normal number or zero as mantissa · 2^exponent.
uint mantissa_of(uint bits) { return (bits & 0x7FFFFFFFu) == 0u ? 0u : (bits & 0x007FFFFFu) | 0x00800000u; }
int exponent_of(uint bits) { return int((bits >> 23) & 0xFFu) - 150; }
int least_exponent(uvec3 bits) {
  int least = 1000;
  for (int i = 0; i < 3; ++i) least = (bits[i] & 0x7FFFFFFFu) == 0u ? least : min(least, exponent_of(bits[i]));
  return least == 1000 ? 0 : least;
}

// x · y in 64 bits, two's complement.
uvec2 signed_product(int x, int y) {
  uint high, low;
  multiply_words(uint(abs(x)), uint(abs(y)), high, low);
  if ((x < 0) != (y < 0)) {
    low = ~low + 1u;
    high = ~high + uint(low == 0u);
  }
  return uvec2(low, high);
}

// E_i by 64-bit integers: |E_i| in product[0..1], the sign returned.
bool exact_edge(int i, out uint product[5]) {
  ivec2 a = corner[(i + 1) % 3];
  ivec2 d = corner[(i + 2) % 3] - a;
  ivec2 p = sample_position() - a;
  uvec2 x = signed_product(d.x, p.y), y = signed_product(d.y, p.x);
  uint low = x.x - y.x;
  uint high = x.y - y.y - uint(x.x < y.x);
  bool negative = (high >> 31) != 0u;
  if (negative) {
    low = ~low + 1u;
    high = ~high + uint(low == 0u);
  }
  product = uint[5](low, high, 0u, 0u, 0u);
  return negative != clockwise;
}

// n · 2^result / d = sum(E_i · w_j · w_k · a_i) · scale / sum(E_i · w_j · w_k); bits: float32 of a_i.
int exact_sums(uvec3 bits, uint scale, out uint n[LIMBS], out uint d[LIMBS]) {
  for (int i = 0; i < LIMBS; ++i) n[i] = d[i] = 0u;
  int least = least_exponent(bits);
  int least_w = least_exponent(uvec3(corner_w[0], corner_w[1], corner_w[2]));
  for (int i = 0; i < 3; ++i) {
    uint product[5];
    bool negative = exact_edge(i, product);
    int shift = 0;
    if (!affine) {
      uint wj = corner_w[(i + 1) % 3], wk = corner_w[(i + 2) % 3];
      multiply(product, mantissa_of(wj));
      multiply(product, mantissa_of(wk));
      shift = exponent_of(wj) + exponent_of(wk) - 2 * least_w;
    }
    add_shifted(d, product, shift, negative);
    if (mantissa_of(bits[i]) != 0u) {
      multiply(product, mantissa_of(bits[i]));
      multiply(product, scale);
      add_shifted(n, product, shift + exponent_of(bits[i]) - least, negative != ((bits[i] >> 31) != 0u));
    }
  }
  return least;
}

Leading exact_number(uvec3 bits, uint scale) {
  uint n[LIMBS], d[LIMBS];
  int least = exact_sums(bits, scale, n, d);
  Leading result = divide(n, d);
  result.e += least;
  return result;
}
)";

const std::string_view kGlslRecords = R"(
ivec2 record(uint index) { return ivec2(index & (RECORD_WIDTH - 1u), index / RECORD_WIDTH); }

uvec4 vertex_words(uint vertex, uint group) { return texelFetch(vertices, record(3u * vertex + group), 0); }

// Positions and w of the triangle's corners, and its edges at this sample.
void set_triangle(uvec4 triangle) {
  for (int i = 0; i < 3; ++i) {
    uvec4 words = vertex_words(triangle[i], 0u);
    corner[i] = ivec2(words.xy);
    corner_w[i] = words.w;
  }
  set_edges();
  set_weights();
}
)";

const std::string_view kGlslTexelChoice = R"(
int floor_of(double x) {
  int i = int(x);
  return double(i) > x ? i - 1 : i;
}

// |value| < 2^31.
int floor_of(Leading v) {
  int places = -v.e;  // of q behind the point
  if (v.q == 0u) return 0;
  if (places > 31) return v.negative ? -1 : 0;
  uint whole = v.q >> places;
  bool inexact = v.more || (whole << places) != v.q;
  return v.negative ? -int(whole) - int(inexact) : int(whole);
}

// floor(u · size); false where doubles cannot decide it.
bool try_index(uvec3 bits, int size, out int index) {
  double lo, hi;
  enclose(bits, lo, hi);
  precise double lowest = lo * double(size), highest = hi * double(size);
  index = floor_of(lowest);
  return index == floor_of(highest);
}

int exact_index(uvec3 bits, int size) { return floor_of(exact_number(bits, uint(size))); }

const int kClamp = 0, kRepeat = 1;  // as etalon::Wrap; 2 mirrors

// The texel in [0, size) that index i names.
int wrapped(int i, int size, int wrap) {
  if (wrap == kClamp) return clamp(i, 0, size - 1);
  int period = wrap == kRepeat ? size : 2 * size;
  int m = i >= 0 ? i % period : period - 1 - (-1 - i) % period;
  return m < size ? m : 2 * size - 1 - m;
}
)";

}  // namespace etalon::gpu
