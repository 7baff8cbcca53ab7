// Small joint problems whose answers are known.
#pragma once

#include <numeric>
#include <vector>

#include "core/base/rng.h"
#include "core/joint/problem.h"

namespace etalon::test {

/// D(i, j) = f(i) + g(j): mesh and texture independent.
inline joint::Problem separable_problem(std::vector<std::uint64_t> mesh_bits, std::vector<std::uint64_t> mesh_error,
                                        std::vector<std::uint64_t> texture_bits, std::vector<std::uint64_t> texture_error) {
  joint::Problem problem{std::move(mesh_bits), std::move(texture_bits), {}};
  problem.error = [f = std::move(mesh_error), g = std::move(texture_error)](std::size_t i, std::size_t j) { return f[i] + g[j]; };
  return problem;
}

/// Levels of rising bits and convexly falling error: the error saved per bit falls strictly from step to step. No two slopes of curves made with
/// different `odd` are equal.
struct ConvexCurve {
  std::vector<std::uint64_t> bits, errors;
};
inline ConvexCurve convex_curve(Rng& rng, std::size_t count, std::uint64_t odd) {
  ConvexCurve curve;
  curve.bits.push_back(1 + rng.next() % 1000);
  std::vector<std::uint64_t> falls;
  std::uint64_t slope = 1'000'000 + odd;
  for (std::size_t n = 1; n < count; ++n) {
    const std::uint64_t step = 1 + rng.next() % 5000;
    curve.bits.push_back(curve.bits.back() + step);
    falls.push_back(slope * step);
    slope -= 2 * (1 + rng.next() % 5000);
  }
  curve.errors.assign(count, 17);
  for (std::size_t n = count - 1; n-- > 0;) curve.errors[n] = curve.errors[n + 1] + falls[n];
  return curve;
}

}  // namespace etalon::test
