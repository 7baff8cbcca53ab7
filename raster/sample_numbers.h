// The numbers of one sample of one triangle: weights and attributes, as enclosures in double and as exact quotients.
#pragma once

#include <array>

#include "core/math/quotient.h"
#include "raster/double_double.h"
#include "raster/sample_values.h"
#include "raster/triangle_setup.h"

namespace etalon::raster {

class SampleNumbers {
 public:
  const TriangleSetup& setup;
  EdgeValues e;
  bool exact_only;
  EvaluationCounters& counters;

  SampleNumbers(const TriangleSetup& triangle, int i, int j, bool only_exact, EvaluationCounters& count)
      : setup(triangle), e(triangle.edges.at(i, j)), exact_only(only_exact), counters(count) {
    for (int k = 0; k < 3; ++k) weight_[k] = static_cast<double>(e[k]) * setup.w_product[k];
    weight_sum_ = weight_[0] + weight_[1] + weight_[2];
  }

  /// Weights are >= 0 and each within 2^-52 (conversion and product), their sum within 2^-51 relative; numerator terms likewise, so that
  /// |error of the quotient| <= 10·2^-53·max|a|. Enclosed by 2^-49·max|a|: the difference covers one later product with a size.
  [[nodiscard]] Interval enclose_attribute(Attribute a) const {
    const ExactTriple& t = setup.attribute[a];
    const double q = (weight_[0] * t.value[0] + weight_[1] * t.value[1] + weight_[2] * t.value[2]) / weight_sum_;
    const double error = t.max_abs * 0x1p-49;
    return {q - error, q + error};
  }

  /// a·size − offset − index, a difference that would cost a double most of its bits: within 2^-90·size·max|a|, all sums and products
  /// being within 2^-100 of terms that are no larger (weights are >= 0), and the last conversion within 2^-53 of the result.
  [[nodiscard]] Interval enclose_fraction(Attribute a, int size, double offset, std::int64_t index) const {
    const ExactTriple& t = setup.attribute[a];
    DoubleDouble numerator, denominator;
    for (std::size_t k = 0; k < 3; ++k) {
      const DoubleDouble weight = double_double(e[k]) * setup.w_product[k];
      numerator = numerator + weight * t.value[k];
      denominator = denominator + weight;
    }
    const DoubleDouble x = numerator / denominator * size + two_sum(-static_cast<double>(index), -offset);
    const double error = t.max_abs * size * 0x1p-90 + (x.high < 0 ? -x.high : x.high) * 0x1p-52;
    return {x.high - error, x.high + error};
  }

  [[nodiscard]] Interval enclose_barycentric(int vertex) const {
    const double q = weight_[static_cast<std::size_t>(vertex)] / weight_sum_;
    return {q * (1 - 0x1p-49), q * (1 + 0x1p-49)};
  }

  template <int kLimbs>
  [[nodiscard]] WideInt<kLimbs> exact_weight(int k) const {
    return WideInt<kLimbs>(e[static_cast<std::size_t>(k)]) * WideInt<kLimbs>(setup.w_exact[static_cast<std::size_t>(k)]);
  }
  template <int kLimbs>
  [[nodiscard]] WideInt<kLimbs> exact_weight_sum() const {
    return exact_weight<kLimbs>(0) + exact_weight<kLimbs>(1) + exact_weight<kLimbs>(2);
  }
  template <int kLimbs>
  [[nodiscard]] Quotient<kLimbs> quotient(Attribute a) const {
    const ExactTriple& t = setup.attribute[a];
    WideInt<kLimbs> n;
    for (int k = 0; k < 3; ++k) n += exact_weight<kLimbs>(k) * WideInt<kLimbs>(t.m[static_cast<std::size_t>(k)]);
    return {n, exact_weight_sum<kLimbs>(), t.k};
  }
  template <int kLimbs>
  [[nodiscard]] Quotient<kLimbs> barycentric(int vertex) const {
    return {exact_weight<kLimbs>(vertex), exact_weight_sum<kLimbs>(), 0};
  }

  /// (|∂a/∂x| + |∂a/∂y|) · size per texel of the frame: |N'·D − N·D'| summed over both directions, over D², rounded once.
  template <int kLimbs>
  [[nodiscard]] float gradient(Attribute a, int size) const {
    const ExactTriple& t = setup.attribute[a];
    const Quotient<kLimbs> q = quotient<kLimbs>(a);
    WideInt<kLimbs> sum;
    for (const bool along_x : {true, false}) {
      WideInt<kLimbs> dn, dd;
      for (std::size_t k = 0; k < 3; ++k) {
        const WideInt<kLimbs> step = WideInt<kLimbs>(edge_step(k, along_x)) * WideInt<kLimbs>(setup.w_exact[k]);
        dd += step;
        dn += step * WideInt<kLimbs>(t.m[k]);
      }
      sum += (dn * q.d - q.n * dd).abs();
    }
    const Quotient<kLimbs> g{sum * WideInt<kLimbs>(size), q.d * q.d, q.k};
    return to_float32(g, enclose(g));
  }

  /// |∂z/∂x| + |∂z/∂y| per texel, affine, rounded once. Steps < 2^47, z integers of 64 bits: 4 limbs.
  [[nodiscard]] float depth_gradient() const {
    const ExactTriple& z = setup.attribute[kDepth];
    WideInt<4> sum;
    for (const bool along_x : {true, false}) {
      WideInt<4> dn;
      for (std::size_t k = 0; k < 3; ++k) dn += WideInt<4>(edge_step(k, along_x)) * WideInt<4>(z.m[k]);
      sum += dn.abs();
    }
    const Quotient<4> g{sum, WideInt<4>(setup.edges.area2), z.k};
    return to_float32(g, enclose(g));
  }

 private:
  /// Change of E_k over one texel.
  [[nodiscard]] std::int64_t edge_step(std::size_t k, bool along_x) const {
    return (along_x ? -setup.edges.dy[k] : setup.edges.dx[k]) << setup.edges.subtexel_bits;
  }
  std::array<double, 3> weight_{};
  double weight_sum_ = 0;
};

}  // namespace etalon::raster
