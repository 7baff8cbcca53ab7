#include "core/procedural/smooth_math.h"

#include <cmath>

namespace etalon::procedural {

double sin_turns(double turns) {
  double t = turns - std::floor(turns + 0.5);  // in [-1/2, 1/2]
  if (t > 0.25) t = 0.5 - t;                   // sin(π − x) = sin x
  if (t < -0.25) t = -0.5 - t;
  const double x = 2 * kPi * t;
  const double q = x * x;
  double sum = 1;
  for (int n = 18; n >= 2; n -= 2) sum = 1 - q / static_cast<double>(n * (n + 1)) * sum;  // Horner of Σ (−1)^k x^2k/(2k+1)!
  return x * sum;
}

double cos_turns(double turns) { return sin_turns(turns - std::floor(turns) + 0.25); }

double length(const Vec3d& a) { return std::sqrt(dot(a, a)); }

Vec3d normalized(const Vec3d& a) {
  const double l = length(a);
  if (!(l > 0)) return {0, 1, 0};
  return {a.x / l, a.y / l, a.z / l};
}

}  // namespace etalon::procedural
