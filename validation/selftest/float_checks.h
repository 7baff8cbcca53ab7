// Does this build, on this machine, in this thread's environment, compute as docs/contract.md supposes? IEEE 754, nothing contracted,
// nothing re-associated, subnormals kept. Every operand is read through `volatile`, so that the processor answers and not the compiler.
#pragma once

#include <string>
#include <vector>

namespace etalon::validation {

struct FloatCheck {
  std::string name;      ///< "a product is rounded before it is added"
  std::string expected;  ///< hexadecimal floats, or words
  std::string got;
  [[nodiscard]] bool passed() const { return got == expected; }
};

/// In the calling thread, as it is: hold a DefaultFloatEnvironment to check what etalon's own entries work in.
[[nodiscard]] std::vector<FloatCheck> float_checks();

}  // namespace etalon::validation
