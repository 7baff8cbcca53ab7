#include "core/procedural/smooth_math.h"

#include <array>
#include <cmath>

namespace etalon::procedural {

namespace {

/// (−1)^k/(2k+1)! for k = 9, 8, …, 0; the factorials up to 19! are integers below 2^57 whose nearest doubles divide to within an ulp.
constexpr std::array<double, 10> kSeries = [] {
  std::array<double, 10> series{};
  double factorial = 1;
  for (int k = 0; k < 10; ++k) {
    if (k > 0) factorial *= static_cast<double>(2 * k * (2 * k + 1));
    series[static_cast<std::size_t>(9 - k)] = (k % 2 == 0 ? 1 : -1) / factorial;
  }
  return series;
}();

}  // namespace

double sin_turns(double turns) {
  double t = turns - std::floor(turns + 0.5);  // in [-1/2, 1/2]
  if (t > 0.25) t = 0.5 - t;                   // sin(π − x) = sin x
  if (t < -0.25) t = -0.5 - t;
  const double x = 2 * kPi * t;
  const double q = x * x;
  double sum = 0;  // Horner's scheme of Σ (−1)^k x^2k / (2k+1)!
  for (const double c : kSeries) sum = sum * q + c;
  return x * sum;
}

double cos_turns(double turns) { return sin_turns(turns - std::floor(turns) + 0.25); }

}  // namespace etalon::procedural
