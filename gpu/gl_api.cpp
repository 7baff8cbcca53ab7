#include "gpu/gl_api.h"

#include <fmt/core.h>

#include "core/base/error.h"

namespace etalon::gpu::gl {

namespace {

std::string error_name(Enum error) {
  switch (error) {
    case kInvalidEnum: return "GL_INVALID_ENUM";
    case kInvalidValue: return "GL_INVALID_VALUE";
    case kInvalidOperation: return "GL_INVALID_OPERATION";
    case kOutOfMemory: return "GL_OUT_OF_MEMORY";
    case kInvalidFramebufferOperation: return "GL_INVALID_FRAMEBUFFER_OPERATION";
    default: return fmt::format("GL error 0x{:04x}", error);
  }
}

}  // namespace

Api load_api(const std::function<ProcAddress(const char*)>& get_proc_address) {
  Api api;
#define ETALON_GL_LOAD_FUNCTION(result, member, name, parameters)                    \
  api.member = reinterpret_cast<result(*) parameters>(get_proc_address("gl" #name)); \
  if (api.member == nullptr) throw UnavailableError("OpenGL: the library has no gl" #name);
  ETALON_GL_FUNCTIONS(ETALON_GL_LOAD_FUNCTION)
#undef ETALON_GL_LOAD_FUNCTION
  return api;
}

void check_error(const Api& gl, const std::string& step) {
  const Enum first = gl.get_error();
  if (first == kNoError) return;
  // A lost context may report for ever; OpenGL 3.3 has at most one flag per kind of error otherwise.
  for (int i = 0; i < 16 && gl.get_error() != kNoError; ++i) {
  }
  throw UnavailableError(fmt::format("OpenGL: {}: {}", step, error_name(first)));
}

}  // namespace etalon::gpu::gl
