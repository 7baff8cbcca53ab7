// An OpenGL 3.3 core context without a window. Every GL function comes from the context, none from the linker.
// OSMesa and EGL are loaded at run time; where they are missing make_context() says so and the rest of etalon works on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "gpu/gl_api.h"

namespace etalon::gpu {

/// The kinds of context; each is one .cpp file that implements Context.
enum class Platform : std::uint8_t {
  automatic,  ///< OSMesa; where that gives no context, EGL
  osmesa,
  egl,  ///< without a surface: a GPU where there is one, else Mesa's software rasterizer
};

/// Mesa's software rasterizers; device_default: what the platform gives. Mesa reads its choice once per process, at the first context.
enum class Driver : std::uint8_t { device_default, llvmpipe, softpipe };

struct ContextOptions {
  Platform platform = Platform::automatic;
  Driver driver = Driver::device_default;
  /// llvmpipe's worker threads, 0 = draw in the calling thread, -1 = Mesa's choice; images do not depend on it.
  /// Like the driver it counts for the first context of the process only, and is ignored after that.
  int threads = -1;
  std::string library_path;  ///< empty: libOSMesa.so.8, .so.6, .so; libEGL.so.1, .so in this order; not with Platform::automatic
};

/// A context; not thread-safe: one thread at a time may use it, after make_current().
class Context {
 public:
  virtual ~Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Makes it the calling thread's current context; UnavailableError where the library refuses.
  virtual void make_current() = 0;

  /// "OSMesa (libOSMesa.so.8)": where the context comes from.
  [[nodiscard]] virtual std::string origin() const = 0;

  /// The functions, valid while this context is current.
  [[nodiscard]] const gl::Api& gl() const { return gl_; }

 protected:
  Context() = default;
  /// To be called by the maker once the context is current: loads the functions, refuses what is older than 3.3.
  void load(const std::function<gl::ProcAddress(const char*)>& get_proc_address);

 private:
  gl::Api gl_;
};

/// A new 3.3 core context, current on the calling thread.
/// Sets the environment variables GALLIUM_DRIVER, LIBGL_ALWAYS_SOFTWARE, LP_NUM_THREADS (as asked) and MESA_SHADER_CACHE_DISABLE (so that
/// nothing is written to the user's home) before the first context; call it before other threads read the environment.
/// UnavailableError, one line: the library is missing or too old, it has no 3.3 core, or another driver or platform was chosen earlier in
/// this process (the two platforms' libraries share Mesa's dispatch tables: contexts of both in one thread would draw into each other).
[[nodiscard]] std::unique_ptr<Context> make_context(const ContextOptions& options = {});

[[nodiscard]] std::string to_string(Platform platform);
[[nodiscard]] std::string to_string(Driver driver);

}  // namespace etalon::gpu
