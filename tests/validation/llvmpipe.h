// The device of these tests: llvmpipe, made once; tests that need it are reported as skipped where there is none.
#pragma once

#include <memory>
#include <string>

#include "core/base/error.h"
#include "gpu/gl_renderer.h"
#include "tests/support/skip.h"

namespace etalon::test {

inline gpu::GlRenderer* llvmpipe_or_skip(const std::string& test_case) {
  static std::string reason;
  static const std::unique_ptr<gpu::GlRenderer> renderer = [] {
    std::unique_ptr<gpu::GlRenderer> made;
    try {
      made = std::make_unique<gpu::GlRenderer>(gpu::ContextOptions{.driver = gpu::Driver::llvmpipe});
      if (made->name().find("llvmpipe") == std::string::npos) {
        reason = "the driver is " + made->name() + ", the bounds are llvmpipe's";
        made.reset();
      }
    } catch (const UnavailableError& error) {
      reason = error.what();
    }
    return made;
  }();
  if (renderer == nullptr) report_skip(test_case, reason);
  return renderer.get();
}

}  // namespace etalon::test
