#include "gpu/context.h"

#include <cstdlib>
#include <mutex>
#include <optional>
#include <string_view>

#include <fmt/core.h>

#include "core/base/error.h"
#include "gpu/egl_context.h"
#include "gpu/osmesa_context.h"

namespace etalon::gpu {

namespace {

/// Mesa's process-wide choices, made by the first context.
class DriverChoice {
 public:
  void make(const ContextOptions& options) {
    const std::lock_guard lock(mutex_);
    if (chosen_) {
      if (options.driver == Driver::device_default || options.driver == *chosen_) return;
      throw UnavailableError(
          fmt::format("OpenGL: Mesa's driver is chosen once per process and is {} already; {} needs a process of its own",
                      to_string(*chosen_), to_string(options.driver)));
    }
    if (options.driver != Driver::device_default) {
      setenv("GALLIUM_DRIVER", to_string(options.driver).c_str(), 1);
      setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);  // EGL's surfaceless platform would take a GPU
    }
    // Mesa 22.3's OSMesa crashes on a name it does not know.
    const char* driver = std::getenv("GALLIUM_DRIVER");
    if (driver != nullptr && *driver != '\0' && std::string_view(driver) != "llvmpipe" && std::string_view(driver) != "softpipe") {
      throw UnavailableError(
          fmt::format("OpenGL: expected llvmpipe or softpipe in the environment variable GALLIUM_DRIVER, got '{}'", driver));
    }
    if (options.threads >= 0) setenv("LP_NUM_THREADS", std::to_string(options.threads).c_str(), 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  }

  /// The platform of the process, or nothing yet.
  std::optional<Platform> platform() {
    const std::lock_guard lock(mutex_);
    return platform_;
  }

  void keep(const Context& context, Platform platform) {
    const std::lock_guard lock(mutex_);
    if (chosen_) return;
    platform_ = platform;
    const std::string renderer = reinterpret_cast<const char*>(context.gl().get_string(gl::kRenderer));
    chosen_ = Driver::device_default;  // another driver, a GPU's: neither of Mesa's two can be had any more
    if (renderer.rfind("llvmpipe", 0) == 0) chosen_ = Driver::llvmpipe;
    if (renderer.rfind("softpipe", 0) == 0) chosen_ = Driver::softpipe;
  }

 private:
  std::mutex mutex_;
  std::optional<Driver> chosen_;  ///< set once a context has been made
  std::optional<Platform> platform_;
};

DriverChoice& driver_choice() {
  static DriverChoice choice;
  return choice;
}

}  // namespace

void Context::load(const std::function<gl::ProcAddress(const char*)>& get_proc_address) {
  gl_ = gl::load_api(get_proc_address);
  gl::Int major = 0;
  gl::Int minor = 0;
  gl_.get_integerv(gl::kMajorVersion, &major);
  gl_.get_integerv(gl::kMinorVersion, &minor);
  if (major < 3 || (major == 3 && minor < 3)) {
    throw UnavailableError(fmt::format("OpenGL: {} gives version {}.{}, etalon needs 3.3 core", origin(), major, minor));
  }
}

std::unique_ptr<Context> make_context(const ContextOptions& options) {
  const std::optional<Platform> before = driver_choice().platform();
  if (before && options.platform != Platform::automatic && options.platform != *before)
    throw UnavailableError(fmt::format("OpenGL: the platform is chosen once per process and is {} already; {} needs a process of its own",
                                       to_string(*before), to_string(options.platform)));
  driver_choice().make(options);
  const auto made = [](std::unique_ptr<Context> context, Platform platform) {
    driver_choice().keep(*context, platform);
    return context;
  };
  const Platform platform = before.value_or(options.platform);
  if (platform == Platform::egl) return made(make_egl_context(options), Platform::egl);
  try {
    return made(make_osmesa_context(options.library_path), Platform::osmesa);
  } catch (const UnavailableError& no_osmesa) {
    if (platform == Platform::osmesa) throw;
    try {
      return made(make_egl_context(options), Platform::egl);
    } catch (const UnavailableError&) {
      throw no_osmesa;
    }
  }
}

std::string to_string(Platform platform) {
  switch (platform) {
    case Platform::automatic: return "auto";
    case Platform::osmesa: return "osmesa";
    case Platform::egl: return "egl";
  }
  return "?";
}

std::string to_string(Driver driver) {
  switch (driver) {
    case Driver::device_default: return "default";
    case Driver::llvmpipe: return "llvmpipe";
    case Driver::softpipe: return "softpipe";
  }
  return "?";
}

}  // namespace etalon::gpu
