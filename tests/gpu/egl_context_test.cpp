// Contexts from EGL; the suites of the renderer run beside these in the same process.
#include <doctest/doctest.h>

#include "core/base/error.h"
#include "tests/gpu/gl_fixture.h"

using namespace etalon;
using namespace etalon::gpu;
using namespace etalon::gpu::test;

namespace {

std::string refusal(const ContextOptions& options) {
  try {
    static_cast<void>(make_context(options));
  } catch (const UnavailableError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("EGL: a missing library is UnavailableError, with the library's name in one line") {
  const std::string line = refusal({.platform = Platform::egl, .driver = Driver::llvmpipe, .library_path = "/nonexistent/libEGL.so.1"});
  CHECK(line.rfind("OpenGL: EGL is not installed (package libegl1): ", 0) == 0);
  CHECK(line.find("/nonexistent/libEGL.so.1") != std::string::npos);
  CHECK(line.find('\n') == std::string::npos);
}

TEST_CASE("EGL: a library that is something else is refused by the symbol it lacks") {
  CHECK(refusal({.platform = Platform::egl, .driver = Driver::llvmpipe, .library_path = "libm.so.6"}) ==
        "OpenGL: libm.so.6 has no eglGetProcAddress");
}

TEST_CASE("EGL: the platform is chosen once per process") {
  if (renderer_or_skip("EGL platform choice") == nullptr) return;
  CHECK(refusal({.platform = Platform::osmesa}) ==
        "OpenGL: the platform is chosen once per process and is egl already; osmesa needs a process of its own");
  CHECK(refusal({.platform = Platform::automatic}).empty());
  CHECK(refusal({.platform = Platform::egl, .driver = Driver::softpipe}) ==
        "OpenGL: Mesa's driver is chosen once per process and is llvmpipe already; softpipe needs a process of its own");
}

TEST_CASE("EGL: several contexts live side by side, and go one by one") {
  GlRenderer* renderer = renderer_or_skip("EGL several contexts");
  if (renderer == nullptr) return;
  CHECK(renderer->device().renderer.rfind("llvmpipe", 0) == 0);
  std::vector<std::unique_ptr<Context>> contexts;
  for (int i = 0; i < 4; ++i) contexts.push_back(make_context());
  for (const auto& context : contexts) {
    context->make_current();
    gl::Int major = 0;
    context->gl().get_integerv(gl::kMajorVersion, &major);
    CHECK(major >= 3);
    CHECK(context->origin().rfind("EGL (libEGL.so", 0) == 0);
  }
  while (contexts.size() > 1) {
    contexts.erase(contexts.begin());
    contexts.front()->make_current();
    CHECK(contexts.front()->gl().get_error() == gl::kNoError);
  }
}
