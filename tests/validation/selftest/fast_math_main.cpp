// Prints which of float_checks() fail in this build: it is compiled with -ffast-math.
#include <cstdio>

#include "validation/selftest/float_checks.h"

int main() {
  for (const etalon::validation::FloatCheck& check : etalon::validation::float_checks())
    if (!check.passed()) std::printf("failed: %s: expected %s, got %s\n", check.name.c_str(), check.expected.c_str(), check.got.c_str());
}
