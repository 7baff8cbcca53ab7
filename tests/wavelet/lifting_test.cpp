#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/wavelet/lifting.h"

using namespace etalon;
using namespace etalon::wavelet;

namespace {

Plane<std::int32_t> random_integers(int width, int height, std::int64_t magnitude, std::uint64_t seed) {
  Plane<std::int32_t> plane(width, height);
  Rng rng(seed);
  for (std::int32_t& v : plane.values) v = static_cast<std::int32_t>(rng.between(-magnitude, magnitude));
  return plane;
}

Plane<double> as_real(const Plane<std::int32_t>& integers) {
  Plane<double> plane(integers.width, integers.height);
  std::ranges::copy(integers.values, plane.values.begin());
  return plane;
}

double greatest_difference(const Plane<double>& a, const Plane<double>& b) {
  double greatest = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) greatest = std::max(greatest, std::abs(a.values[i] - b.values[i]));
  return greatest;
}

}  // namespace

TEST_CASE("5/3: one line by hand") {
  // d = x1 - floor((x0 + x2)/2): 20 - 15 = 5, 40 - floor((20+51)/2)... of 10 20 20 40 51: d0 = 20 - 15 = 5, d1 = 40 - 35 = 5;
  // s = x0 + floor((d + d + 2)/4), mirrored: 10 + floor(12/4) = 13, 20 + 3 = 23, 51 + 3 = 54.
  Plane<std::int32_t> line(5, 1);
  line.values = {10, 20, 20, 40, 51};
  forward(line, 1);
  CHECK(line.values == std::vector<std::int32_t>{13, 23, 54, 5, 5});
  // The same as a column.
  Plane<std::int32_t> column(1, 5);
  column.values = {10, 20, 20, 40, 51};
  forward(column, 1);
  CHECK(column.values == std::vector<std::int32_t>{13, 23, 54, 5, 5});
}

TEST_CASE("5/3: exactly reversible at every size, also where integers wrap") {
  for (int height = 1; height <= 17; ++height) {
    for (int width = 1; width <= 17; ++width) {
      for (const std::int64_t magnitude : {std::int64_t{255}, std::int64_t{std::numeric_limits<std::int32_t>::max()}}) {
        const auto plane = random_integers(width, height, magnitude, static_cast<std::uint64_t>(100 * height + width));
        auto there = plane;
        forward(there, 5);
        inverse(there, 5);
        REQUIRE(there == plane);
      }
    }
  }
  const auto wide = random_integers(301, 203, 255, 1);
  auto there = wide;
  forward(there, kMaxLevels);
  CHECK(there != wide);
  inverse(there, kMaxLevels);
  CHECK(there == wide);
}

TEST_CASE("9/7: there and back within the derived bound") {
  double worst = 0;
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {1, 3}, {5, 4}, {33, 17}, {256, 129}}) {
    for (const int levels : {1, 3, 6}) {
      const Plane<double> plane = as_real(random_integers(width, height, 255, 9));
      Plane<double> there = plane;
      forward(there, levels);
      inverse(there, levels);
      const double error = greatest_difference(there, plane), bound = roundtrip_error_bound(levels, 255);
      CHECK(error <= bound);
      worst = std::max(worst, error / bound);
    }
  }
  CHECK(worst > 0);
  CHECK(roundtrip_error_bound(6, 255) < 1e-3);  // far below half a byte: 6 levels lose nothing by themselves
}

TEST_CASE("9/7: a constant has low-pass coefficients of its own value and no others") {
  Plane<double> plane(16, 16);
  std::ranges::fill(plane.values, 100.0);
  forward(plane, 2);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) CHECK(std::abs(plane.row(y)[x] - (x < 4 && y < 4 ? 100.0 : 0.0)) < 1e-10);  // the filters' 15 digits
}

TEST_CASE("9/7: the gains of the error bound are those of the filters") {
  // Column k of the matrix of a line is the transform of its k-th unit; the greatest row sum of absolute values is the norm.
  double analysis = 0, synthesis = 0;
  for (int n = 1; n <= 40; ++n) {
    std::vector<double> rows_there(static_cast<std::size_t>(n)), rows_back(static_cast<std::size_t>(n));
    for (std::size_t k = 0; k < rows_there.size(); ++k) {
      Plane<double> there(n, 1), back(n, 1);
      there.values[k] = back.values[k] = 1;
      forward(there, 1);
      inverse(back, 1);
      for (std::size_t i = 0; i < rows_there.size(); ++i) {
        rows_there[i] += std::abs(there.values[i]);
        rows_back[i] += std::abs(back.values[i]);
      }
    }
    analysis = std::max(analysis, std::ranges::max(rows_there));
    synthesis = std::max(synthesis, std::ranges::max(rows_back));
  }
  CHECK(analysis <= kAnalysisGain);
  CHECK(analysis > kAnalysisGain - 0.002);
  CHECK(synthesis <= kSynthesisGain);
  CHECK(synthesis > kSynthesisGain - 0.002);
}

TEST_CASE("transforms: the same bytes for every number of threads") {
  const auto integers = random_integers(333, 211, 255, 4);
  auto first_integers = integers;
  auto first_reals = as_real(integers);
  set_thread_count(1);
  forward(first_integers, 6);
  forward(first_reals, 6);
  for (const int threads : {2, 7}) {
    set_thread_count(threads);
    auto again = integers;
    auto reals = as_real(integers);
    forward(again, 6);
    forward(reals, 6);
    CHECK(again == first_integers);
    CHECK(reals == first_reals);
  }
  set_thread_count(0);
}
