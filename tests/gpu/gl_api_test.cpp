// Our own table of OpenGL's numbers is the registry's, and loading names what is missing.
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "gpu/gl_api.h"
#include "tests/support/skip.h"

#if __has_include(<GL/glcorearb.h>)
#include <GL/glcorearb.h>
#define ETALON_HAS_GL_HEADER
#endif

using namespace etalon;
using namespace etalon::gpu;

TEST_CASE("the constants are those of glcorearb.h") {
#ifdef ETALON_HAS_GL_HEADER
#define ETALON_CHECK_CONSTANT(constant, name, value) CHECK_MESSAGE(gl::constant == GL_##name, #name);
  ETALON_GL_CONSTANTS(ETALON_CHECK_CONSTANT)
#undef ETALON_CHECK_CONSTANT
#else
  etalon::test::report_skip("gl constants", "GL/glcorearb.h is not installed (package libgl-dev)");
#endif
}

#ifdef ETALON_HAS_GL_HEADER
#define ETALON_CHECK_TYPE(type, header_type) static_assert(sizeof(gl::type) == sizeof(header_type));
ETALON_CHECK_TYPE(Enum, GLenum)
ETALON_CHECK_TYPE(Boolean, GLboolean)
ETALON_CHECK_TYPE(Int, GLint)
ETALON_CHECK_TYPE(Uint, GLuint)
ETALON_CHECK_TYPE(Sizei, GLsizei)
ETALON_CHECK_TYPE(Sizeiptr, GLsizeiptr)
ETALON_CHECK_TYPE(Float, GLfloat)
ETALON_CHECK_TYPE(Double, GLdouble)
#undef ETALON_CHECK_TYPE
#endif

TEST_CASE("a library without one of the functions is refused by that function's name") {
  const auto almost_all = [](const char* name) -> gl::ProcAddress {
    return std::string(name) == "glDrawBuffers" ? nullptr : gl::ProcAddress([] {});
  };
  CHECK_THROWS_WITH_AS(static_cast<void>(gl::load_api(almost_all)), "OpenGL: the library has no glDrawBuffers", UnavailableError);
}

TEST_CASE("a pending error is reported with its step, and once") {
  gl::Api api;
  static gl::Enum pending = gl::kOutOfMemory;
  api.get_error = []() -> gl::Enum { return std::exchange(pending, gl::kNoError); };
  CHECK_THROWS_WITH_AS(gl::check_error(api, "drawing"), "OpenGL: drawing: GL_OUT_OF_MEMORY", UnavailableError);
  CHECK_NOTHROW(gl::check_error(api, "drawing"));
}
