// Where OpenGL is missing or refuses, one line says what and why.
#include "gpu/context.h"

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

TEST_CASE("a missing library is UnavailableError, with the library's name in one line") {
  const std::string line = refusal({.library_path = "/nonexistent/libOSMesa.so.8"});
  CHECK(line.rfind("OpenGL: OSMesa is not installed (package libosmesa6): ", 0) == 0);
  CHECK(line.find("/nonexistent/libOSMesa.so.8") != std::string::npos);
  CHECK(line.find('\n') == std::string::npos);
}

TEST_CASE("a library that is not OSMesa is refused by the symbol it lacks") {
  CHECK(refusal({.library_path = "libm.so.6"}) == "OpenGL: libm.so.6 has no OSMesaCreateContextAttribs");
}

TEST_CASE("the driver is chosen once per process") {
  if (renderer_or_skip("gpu driver choice") == nullptr) return;
  CHECK(refusal({.driver = Driver::softpipe}) ==
        "OpenGL: Mesa's driver is chosen once per process and is llvmpipe already; softpipe needs a process of its own");
  CHECK(refusal({.driver = Driver::llvmpipe}).empty());
  CHECK(refusal({.driver = Driver::device_default}).empty());
}

TEST_CASE("several contexts live side by side") {
  GlRenderer* renderer = renderer_or_skip("gpu several contexts");
  if (renderer == nullptr) return;
  std::vector<std::unique_ptr<Context>> contexts;
  for (int i = 0; i < 4; ++i) contexts.push_back(make_context());
  for (const auto& context : contexts) {
    context->make_current();
    gl::Int major = 0;
    context->gl().get_integerv(gl::kMajorVersion, &major);
    CHECK(major >= 3);
    CHECK(context->origin().rfind("OSMesa (libOSMesa.so", 0) == 0);
  }
}
