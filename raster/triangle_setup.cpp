#include "raster/triangle_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "core/base/error.h"

namespace etalon::raster {
namespace {

int bit_length(__int128 value) {
  const unsigned __int128 a = static_cast<unsigned __int128>(value < 0 ? -value : value);
  const auto high = static_cast<std::uint64_t>(a >> 64), low = static_cast<std::uint64_t>(a);
  return high != 0 ? 128 - std::countl_zero(high) : 64 - std::countl_zero(low);
}

// A canonical float32 as mantissa · 2^exponent, the mantissa odd (or 0 with exponent 0).
struct Split {
  std::int64_t mantissa;
  int exponent;
};
Split split(float a) {
  if (a == 0) return {0, 0};
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(a);
  std::int64_t m = (bits & 0x7FFFFF) | 0x800000;  // canonical() left no subnormals
  const int trailing = std::countr_zero(static_cast<std::uint64_t>(m));
  return {(bits >> 31) != 0 ? -(m >> trailing) : m >> trailing, static_cast<int>(bits >> 23 & 0xFF) - 150 + trailing};
}

int limbs_for(int bits) {
  const int limbs = (bits + 2 + 63) / 64;  // a sign bit and one to spare
  ETALON_CHECK(limbs <= 16, fmt::format("{} bits", bits));
  return limbs;
}

}  // namespace

ExactTriple exact_triple(float a0, float a1, float a2) {
  const std::array<float, 3> a = {canonical(a0), canonical(a1), canonical(a2)};
  ExactTriple t;
  std::array<Split, 3> s;
  int least = 1000;
  for (int i = 0; i < 3; ++i) {
    s[i] = split(a[i]);
    if (s[i].mantissa != 0) least = std::min(least, s[i].exponent);
    t.value[i] = a[i];
    t.max_abs = std::max(t.max_abs, a[i] < 0 ? -static_cast<double>(a[i]) : static_cast<double>(a[i]));
  }
  if (least == 1000) return t;
  t.k = -least;
  for (int i = 0; i < 3; ++i) {
    if (s[i].mantissa == 0) continue;
    t.m[i] = static_cast<__int128>(s[i].mantissa) << (s[i].exponent - least);
    t.bits = std::max(t.bits, bit_length(t.m[i]));
  }
  return t;
}

TriangleSetup make_triangle_setup(const DrawList& list, std::uint32_t t, const Frame& frame) {
  const auto& corner = list.triangles[t];
  const RasterVertex& v0 = list.vertices[corner[0]];
  const RasterVertex& v1 = list.vertices[corner[1]];
  const RasterVertex& v2 = list.vertices[corner[2]];
  TriangleSetup s;
  s.edges = make_edges(v0, v1, v2, frame);
  if (s.edges.i_min > s.edges.i_max || s.edges.j_min > s.edges.j_max) return s;

  s.affine = v0.w == v1.w && v1.w == v2.w;
  int w_bits = 1;
  if (!s.affine) {
    const ExactTriple w = exact_triple(v0.w, v1.w, v2.w);
    w_bits = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      s.w_product[i] = w.value[j] * w.value[k];
      // w in [2^-20, 2^20]: each integer is at most 2^63, the product at most 2^126.
      s.w_exact[i] = w.m[j] * w.m[k];
      w_bits = std::max(w_bits, bit_length(s.w_exact[i]));
    }
  }
  // ΣE_i = area2 with every E_i >= 0 inside, hence ΣE_i·w_i <= area2 · max w_i.
  s.weight_bits = bit_length(s.edges.area2) + w_bits;
  int edge_bits = 0;
  for (int i = 0; i < 3; ++i) edge_bits = std::max({edge_bits, bit_length(s.edges.dx[i]), bit_length(s.edges.dy[i])});
  s.step_bits = edge_bits + s.edges.subtexel_bits + w_bits + 2;  // a sum of three

  s.attribute[kU] = exact_triple(v0.uv.x, v1.uv.x, v2.uv.x);
  s.attribute[kV] = exact_triple(v0.uv.y, v1.uv.y, v2.uv.y);
  for (int c = 0; c < 4; ++c) s.attribute[kRed + c] = exact_triple(v0.color[c], v1.color[c], v2.color[c]);
  s.attribute[kDepth] = exact_triple(v0.z, v1.z, v2.z);
  return s;
}

// Scalars: N = Σ weight·m < 2^(weight + bits), times a size of at most 2^16 or a unorm scale; the comparison multiplies D by a 53-bit
// integer and shifts only to equal lengths.
int TriangleSetup::scalar_limbs(Attribute a) const { return limbs_for(weight_bits + std::max(attribute[a].bits + 18, 55)); }

// Linear: with DU = D·2^(k_u+1) and DV alike, the value is Σ four products of F < DU, G < DV and a texel of texel_bits, over DU·DV·den;
// the sum of the four is at most DU·DV·max|t|. den <= 65535 and the comparison's 53 bits come on the denominator's side.
int TriangleSetup::linear_limbs(int texel_bits) const {
  const int du = weight_bits + std::max(attribute[kU].k, 0) + 1, dv = weight_bits + std::max(attribute[kV].k, 0) + 1;
  // u·n < 2^30 bounds N·n·2^-k against D also where k < 0.
  const int scaled = std::max(du, dv) + 32 + std::max({attribute[kU].bits, attribute[kV].bits, 0});
  return limbs_for(std::max(du + dv + std::max(texel_bits + 17, 72), scaled));
}

// Gradients: |N'·D − N·D'| summed over x and y, times the size, over D².
int TriangleSetup::gradient_limbs() const {
  const int a = std::max({attribute[kU].bits, attribute[kV].bits, attribute[kDepth].bits});
  return limbs_for(std::max(step_bits + weight_bits + a + 3 + 16, 2 * weight_bits + 55));
}

}  // namespace etalon::raster
