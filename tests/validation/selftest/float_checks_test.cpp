#include <doctest/doctest.h>

#include <algorithm>
#include <cfenv>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "validation/selftest/float_checks.h"

using namespace etalon::validation;

namespace {

bool passes(const std::vector<FloatCheck>& checks, const std::string& name) {
  const auto found = std::find_if(checks.begin(), checks.end(), [&](const FloatCheck& check) { return check.name == name; });
  REQUIRE(found != checks.end());
  return found->passed();
}

}  // namespace

TEST_CASE("this build and this machine compute as IEEE 754 says") {
  for (const FloatCheck& check : float_checks()) {
    CAPTURE(check.name);
    CHECK(check.got == check.expected);
  }
}

TEST_CASE("another rounding mode is seen, by its name and by what it does") {
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    REQUIRE(std::fesetround(mode) == 0);
    const std::vector<FloatCheck> checks = float_checks();
    std::fesetround(FE_TONEAREST);
    CHECK_FALSE(passes(checks, "rounding mode"));
    CHECK(passes(checks, "1 + 2^-53 is a tie to even: 1") == (mode != FE_UPWARD));
    CHECK(passes(checks, "1 + 3*2^-53 is a tie to even: 1 + 2^-51") == (mode == FE_UPWARD));
  }
}

#if defined(__SSE2__)
TEST_CASE("flushed subnormals are seen") {
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8000);  // FTZ: results
  const std::vector<FloatCheck> flushed_results = float_checks();
  _mm_setcsr(before | 0x0040);  // DAZ: operands
  const std::vector<FloatCheck> flushed_operands = float_checks();
  _mm_setcsr(before);
  CHECK_FALSE(passes(flushed_results, "double results may be subnormal"));
  CHECK_FALSE(passes(flushed_results, "float32 results may be subnormal"));
  CHECK_FALSE(passes(flushed_results, "conversion to float32 keeps subnormals"));
  CHECK_FALSE(passes(flushed_operands, "double operands may be subnormal"));
  CHECK_FALSE(passes(flushed_operands, "float32 operands may be subnormal"));
}
#endif
