// Everything about one triangle that its samples share: edges, weights and attributes as exact integers, and how wide their sums get.
#pragma once

#include <array>
#include <cstdint>

#include "core/draw/draw_list.h"
#include "raster/edges.h"

namespace etalon::raster {

/// Three float32 as integers of one scale: value i is exactly m[i] · 2^-k.
struct ExactTriple {
  std::array<__int128, 3> m{};
  std::array<double, 3> value{};  ///< the same numbers as doubles
  double max_abs = 0;
  int k = 0;
  int bits = 0;  ///< bit length of the largest |m[i]|
};

[[nodiscard]] ExactTriple exact_triple(float a0, float a1, float a2);

/// The attributes, in this order: uv, colour, depth.
enum Attribute { kU, kV, kRed, kGreen, kBlue, kAlpha, kDepth, kAttributeCount };

struct TriangleSetup {
  Edges edges;
  bool affine = true;                        ///< equal w: weights are the edge values themselves
  std::array<double, 3> w_product{1, 1, 1};  ///< w_j·w_k, exact in double (two 24-bit mantissas)
  std::array<__int128, 3> w_exact{1, 1, 1};  ///< the same as integers of one scale (which cancels in every quotient)
  std::array<ExactTriple, kAttributeCount> attribute;
  int weight_bits = 0;  ///< bit length bound of E_i · w_exact[i] for a sample inside, and of their sum
  int step_bits = 0;    ///< the same for their change over one texel

  /// Limbs that hold every intermediate for inputs in the ranges of docs/contract.md#input; derivations in the .cpp.
  [[nodiscard]] int scalar_limbs(Attribute a) const;
  [[nodiscard]] int linear_limbs(int texel_bits) const;
  [[nodiscard]] int gradient_limbs() const;
};

/// Prepares triangle `t`; colours and uv are canonicalised. The box of `edges` is empty where it draws nothing (then the rest is unset).
[[nodiscard]] TriangleSetup make_triangle_setup(const DrawList& list, std::uint32_t t, const Frame& frame);

/// Calls body.template operator()<kLimbs>() with the smallest instantiated width of at least `limbs`.
template <class Body>
auto with_limbs(int limbs, Body&& body) {
  if (limbs <= 4) return body.template operator()<4>();
  if (limbs <= 8) return body.template operator()<8>();
  return body.template operator()<16>();
}

}  // namespace etalon::raster
