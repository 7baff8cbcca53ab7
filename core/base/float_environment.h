// The floating-point environment every promise of etalon is made in: round to nearest, subnormals kept, no traps.
#pragma once

#include <cfenv>

namespace etalon {

/// While it lives, this thread computes in the C default environment, whatever the caller had set (rounding mode, flush to zero, -Ofast's
/// start-up code); afterwards the caller's is back. Public entries of exact code hold one, and so does every body that parallel_for() runs,
/// since worker threads have environments of their own.
class DefaultFloatEnvironment {
 public:
  DefaultFloatEnvironment() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatEnvironment() { std::fesetenv(&saved_); }
  DefaultFloatEnvironment(const DefaultFloatEnvironment&) = delete;
  DefaultFloatEnvironment& operator=(const DefaultFloatEnvironment&) = delete;

 private:
  std::fenv_t saved_{};
};

}  // namespace etalon
