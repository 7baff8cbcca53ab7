#include "validation/metrics/decibel.h"

#include <cmath>

#include "core/base/error.h"

namespace etalon::validation {
namespace {

constexpr double kLn2 = 0.693147180559945309417232121458;
constexpr double kTenOverLn10 = 4.34294481903251827651128918917;
constexpr double kSqrtHalf = 0.707106781186547524400844362105;

// ln m = 2·atanh(s), s = (m − 1)/(m + 1). For m in [√½, √2) |s| <= 0.1716, so s² <= 0.02944 and the first omitted term,
// 2·s^29/29, is below 1e-23.
double ln_near_one(double m) {
  const double s = (m - 1.0) / (m + 1.0);
  const double s2 = s * s;
  double sum = 0.0;
  for (int k = 27; k >= 1; k -= 2) sum = sum * s2 + 1.0 / k;
  return 2.0 * s * sum;
}

}  // namespace

double decibel(double x) {
  ETALON_CHECK(std::isfinite(x) && x > 0, "decibel of a number that is not positive");
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);  // [½, 1), exact
  if (mantissa < kSqrtHalf) {
    mantissa *= 2.0;
    --exponent;
  }
  return kTenOverLn10 * (exponent * kLn2 + ln_near_one(mantissa));
}

std::optional<double> psnr_db(double sse, std::uint64_t samples, double peak) {
  if (!(sse > 0) || !std::isfinite(sse) || samples == 0) return std::nullopt;
  const double exact = decibel(peak * peak * static_cast<double>(samples) / sse);
  return std::nearbyint(exact * 1e4) / 1e4;
}

}  // namespace etalon::validation
