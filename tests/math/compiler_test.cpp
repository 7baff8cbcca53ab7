// What the compiler must not do to the evaluation: gcc 12.2's SLP vectorizer turns two neighbouring (double)(float)x into x.
#include <doctest/doctest.h>

namespace {

[[gnu::noinline]] void round_pair(double* out, const double* in) {
  const float a = static_cast<float>(in[0]), b = static_cast<float>(in[1]);
  out[0] = static_cast<double>(a);
  out[1] = static_cast<double>(b);
}

TEST_CASE("a double that passes through float32 is rounded, in pairs too") {
  const double third[2] = {1.0 / 3, 1.0 / 7};
  double out[2];
  round_pair(out, third);
  CHECK(out[0] == 0x1.555556p-2);
  CHECK(out[1] == 0x1.24924ap-3);
}

}  // namespace
