#include "validation/selftest/float_checks.h"

#include <bit>
#include <cfenv>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

namespace etalon::validation {
namespace {

// Integers do not pass through the floating-point unit: what was computed, bit by bit.
std::string bits_of(double value) { return fmt::format("{:016x}", std::bit_cast<std::uint64_t>(value)); }
std::string bits_of(float value) { return fmt::format("{:08x}", std::bit_cast<std::uint32_t>(value)); }

double opaque(double value) {
  volatile double kept = value;
  return kept;
}

float opaque(float value) {
  volatile float kept = value;
  return kept;
}

// The shapes that compilers look for, each in a function of its own.
[[gnu::noinline]] double product_plus(double a, double b, double c) { return a * b + c; }
[[gnu::noinline]] double sum_minus(double a, double b) { return (a + b) - a; }
[[gnu::noinline]] double divided(double a, double b) { return a / b; }
[[gnu::noinline]] double plus_zero(double a) { return a + 0.0; }
[[gnu::noinline]] bool differs_from_itself(double a) { return a != a; }  // NOLINT(misc-redundant-expression)
[[gnu::noinline]] void round_pair(double* out, const double* in) {
  const float a = static_cast<float>(in[0]), b = static_cast<float>(in[1]);
  out[0] = static_cast<double>(a);
  out[1] = static_cast<double>(b);
}

const char* name_of_rounding(int mode) {
  switch (mode) {
    case FE_TONEAREST: return "to nearest";
    case FE_UPWARD: return "upward";
    case FE_DOWNWARD: return "downward";
    case FE_TOWARDZERO: return "toward zero";
    default: return "unknown";
  }
}

void check_environment(std::vector<FloatCheck>& checks) {
  checks.push_back({"rounding mode", "to nearest", name_of_rounding(std::fegetround())});
  checks.push_back({"1 + 2^-53 is a tie to even: 1", bits_of(1.0), bits_of(opaque(1.0) + opaque(0x1p-53))});
  checks.push_back({"1 + 3*2^-53 is a tie to even: 1 + 2^-51", bits_of(1 + 0x1p-51), bits_of(opaque(1.0) + opaque(0x3p-53))});
  checks.push_back({"double results may be subnormal", "0008000000000000", bits_of(opaque(0x1p-1022) * opaque(0.5))});
  checks.push_back({"double operands may be subnormal", "3ff0000000000000",
                    bits_of(opaque(std::bit_cast<double>(std::uint64_t{1} << 51)) * opaque(0x1p1023))});
  checks.push_back({"float32 results may be subnormal", "00400000", bits_of(opaque(0x1p-126f) * opaque(0.5f))});
  checks.push_back(
      {"float32 operands may be subnormal", "3f800000", bits_of(opaque(std::bit_cast<float>(std::uint32_t{1} << 22)) * opaque(0x1p127f))});
  checks.push_back({"conversion to float32 keeps subnormals", "00000001", bits_of(static_cast<float>(opaque(0x1p-149)))});
}

void check_compiler(std::vector<FloatCheck>& checks) {
  // (1 + 2^-30)^2 = 1 + 2^-29 + 2^-60: the last term is lost where the product is rounded, and kept by a fused multiply-add.
  const double a = opaque(1 + 0x1p-30);
  checks.push_back({"a product is rounded before it is added", bits_of(0x1p-29), bits_of(product_plus(a, a, opaque(-1.0)))});
  checks.push_back({"sums are not re-associated", bits_of(0.0), bits_of(sum_minus(opaque(0x1p60), opaque(1.0)))});
  checks.push_back({"-0 + 0 is +0", bits_of(0.0), bits_of(plus_zero(opaque(-0.0)))});
  checks.push_back(
      {"a NaN differs from itself", "yes", differs_from_itself(opaque(std::numeric_limits<double>::quiet_NaN())) ? "yes" : "no"});
  checks.push_back({"no excess precision", "0", std::to_string(int{FLT_EVAL_METHOD})});
  const double in[2] = {opaque(1.0 / 3), opaque(1.0 / 7)};
  double out[2];
  round_pair(out, in);
  checks.push_back({"a double that passes through float32 is rounded", bits_of(0x1.555556p-2), bits_of(out[0])});
  checks.push_back({"a pair of them too", bits_of(0x1.24924ap-3), bits_of(out[1])});
}

void check_operations(std::vector<FloatCheck>& checks) {
  checks.push_back({"division is correctly rounded", "3fd5555555555555", bits_of(divided(opaque(1.0), opaque(3.0)))});
  checks.push_back({"division by a constant is a division", "3fb999999999999a", bits_of(divided(opaque(1.0), 10.0))});
  checks.push_back({"the square root is correctly rounded", "3ff6a09e667f3bcd", bits_of(std::sqrt(opaque(2.0)))});
  checks.push_back({"conversion to float32 rounds to nearest, ties to even", "4b800000", bits_of(static_cast<float>(opaque(16777217.0)))});
  volatile std::uint64_t large = (std::uint64_t{1} << 53) + 1;
  checks.push_back(
      {"conversion of 64-bit integers rounds to nearest, ties to even", "4340000000000000", bits_of(static_cast<double>(large))});
}

}  // namespace

std::vector<FloatCheck> float_checks() {
  static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<float>::is_iec559);
  std::vector<FloatCheck> checks;
  check_environment(checks);
  check_compiler(checks);
  check_operations(checks);
  return checks;
}

}  // namespace etalon::validation
