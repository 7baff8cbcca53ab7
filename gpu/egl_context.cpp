#include "gpu/egl_context.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/base/error.h"
#include "gpu/shared_library.h"

namespace etalon::gpu {

namespace {

// From the EGL registry: EGL 1.5, EGL_EXT_platform_base, EGL_EXT_platform_device, EGL_EXT_device_query, EGL_MESA_platform_surfaceless.
using Pointer = void*;
using EglEnum = std::uint32_t;
constexpr std::int32_t kNone = 0x3038, kExtensions = 0x3055, kVendor = 0x3053;
constexpr std::int32_t kRenderableType = 0x3040, kOpenGlBit = 0x0008, kSurfaceType = 0x3033;
constexpr std::int32_t kMajorVersion = 0x3098, kMinorVersion = 0x30FB, kProfileMask = 0x30FD, kCoreProfileBit = 0x0001;
constexpr EglEnum kOpenGlApi = 0x30A2, kPlatformDevice = 0x313F, kPlatformSurfaceless = 0x31DD;

struct Egl {
  explicit Egl(const ContextOptions& options)
      : library(options.library_path.empty() ? std::vector<std::string>{"libEGL.so.1", "libEGL.so"} : std::vector{options.library_path},
                "EGL is not installed (package libegl1)") {
    library.find("eglGetProcAddress", get_proc_address);
    library.find("eglQueryString", query_string);
    library.find("eglInitialize", initialize);
    library.find("eglBindAPI", bind_api);
    library.find("eglChooseConfig", choose_config);
    library.find("eglCreateContext", create_context);
    library.find("eglDestroyContext", destroy_context);
    library.find("eglMakeCurrent", make_current);
    library.find("eglGetCurrentContext", get_current_context);
    const auto extension = [&](const char* name, auto& function) {
      function = reinterpret_cast<std::decay_t<decltype(function)>>(get_proc_address(name));
    };
    extension("eglGetPlatformDisplayEXT", get_platform_display);
    extension("eglQueryDevicesEXT", query_devices);
    extension("eglQueryDeviceStringEXT", query_device_string);
  }

  SharedLibrary library;
  gl::ProcAddress (*get_proc_address)(const char* name) = nullptr;
  const char* (*query_string)(Pointer display, std::int32_t name) = nullptr;
  std::uint32_t (*initialize)(Pointer display, std::int32_t* major, std::int32_t* minor) = nullptr;
  std::uint32_t (*bind_api)(EglEnum api) = nullptr;
  std::uint32_t (*choose_config)(Pointer display, const std::int32_t* attributes, Pointer* configs, std::int32_t size,
                                 std::int32_t* count) = nullptr;
  Pointer (*create_context)(Pointer display, Pointer config, Pointer shared, const std::int32_t* attributes) = nullptr;
  std::uint32_t (*destroy_context)(Pointer display, Pointer context) = nullptr;
  std::uint32_t (*make_current)(Pointer display, Pointer draw, Pointer read, Pointer context) = nullptr;
  Pointer (*get_current_context)() = nullptr;
  Pointer (*get_platform_display)(EglEnum platform, Pointer native, const std::int32_t* attributes) = nullptr;
  std::uint32_t (*query_devices)(std::int32_t size, Pointer* devices, std::int32_t* count) = nullptr;
  const char* (*query_device_string)(Pointer device, std::int32_t name) = nullptr;
};

bool has_word(const char* words, std::string_view word) {
  std::string_view rest = words != nullptr ? words : "";
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == word) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

struct Place {
  EglEnum platform = kPlatformSurfaceless;
  Pointer native = nullptr;
  std::string name = "surfaceless";
};

std::vector<Place> places_of(const Egl& egl, Driver driver) {
  const char* const known = egl.query_string(nullptr, kExtensions);
  if (egl.get_platform_display == nullptr || !has_word(known, "EGL_EXT_platform_base"))
    throw UnavailableError(fmt::format("OpenGL: {} has no EGL_EXT_platform_base", egl.library.name()));
  std::vector<Place> places;
  if (driver == Driver::device_default && has_word(known, "EGL_EXT_platform_device") && egl.query_devices != nullptr) {
    std::array<Pointer, 32> devices{};
    std::int32_t count = 0;
    if (egl.query_devices(static_cast<std::int32_t>(devices.size()), devices.data(), &count) == 0) count = 0;
    const auto software = [&](int n) {
      const char* const about = egl.query_device_string != nullptr ? egl.query_device_string(devices[std::size_t(n)], kExtensions) : "";
      return has_word(about, "EGL_MESA_device_software");
    };
    for (const bool want_software : {false, true})
      for (int n = 0; n < count; ++n)
        if (software(n) == want_software) places.push_back({kPlatformDevice, devices[std::size_t(n)], fmt::format("device {}", n)});
  }
  if (has_word(known, "EGL_MESA_platform_surfaceless")) places.emplace_back();
  return places;
}

class EglContext final : public Context {
 public:
  EglContext(Egl egl, const Place& place) : egl_(std::move(egl)), place_(place.name) {
    display_ = egl_.get_platform_display(place.platform, place.native, nullptr);
    std::int32_t major = 0, minor = 0;
    if (display_ == nullptr || egl_.initialize(display_, &major, &minor) == 0) refuse("cannot be opened");
    if (!has_word(egl_.query_string(display_, kExtensions), "EGL_KHR_surfaceless_context")) refuse("wants a surface");
    const char* const vendor = egl_.query_string(display_, kVendor);
    vendor_ = vendor != nullptr ? vendor : "?";
    const std::int32_t wanted[] = {kRenderableType, kOpenGlBit, kSurfaceType, 0, kNone};
    Pointer config = nullptr;
    std::int32_t configs = 0;
    if (egl_.bind_api(kOpenGlApi) == 0 || egl_.choose_config(display_, wanted, &config, 1, &configs) == 0 || configs < 1)
      refuse("has no OpenGL");
    const std::int32_t version[] = {kMajorVersion, 3, kMinorVersion, 3, kProfileMask, kCoreProfileBit, kNone};
    context_ = egl_.create_context(display_, config, nullptr, version);
    if (context_ == nullptr) refuse("gives no 3.3 core context");
    try {
      make_current();
      load(egl_.get_proc_address);
    } catch (...) {
      release();
      throw;
    }
  }

  ~EglContext() override { release(); }

  void make_current() override {
    if (egl_.make_current(display_, nullptr, nullptr, context_) == 0) refuse("the context cannot be made current");
  }

  std::string origin() const override { return fmt::format("EGL ({}, {}, {})", egl_.library.name(), vendor_, place_); }

 private:
  [[noreturn]] void refuse(const char* what) const {
    throw UnavailableError(fmt::format("OpenGL: {}: {}: {}", egl_.library.name(), place_, what));
  }

  // The display stays initialised: other contexts share it.
  void release() {
    if (egl_.get_current_context() == context_) egl_.make_current(display_, nullptr, nullptr, nullptr);
    egl_.destroy_context(display_, context_);
  }

  Egl egl_;
  std::string place_, vendor_;
  Pointer display_ = nullptr, context_ = nullptr;
};

}  // namespace

std::unique_ptr<Context> make_egl_context(const ContextOptions& options) {
  const Egl egl(options);
  std::string reasons;
  for (const Place& place : places_of(egl, options.driver)) {
    try {
      return std::make_unique<EglContext>(egl, place);
    } catch (const UnavailableError& error) {
      reasons += (reasons.empty() ? "" : "; ") + std::string(error.what());
    }
  }
  throw UnavailableError(reasons.empty() ? fmt::format("OpenGL: {} has no device and no surfaceless platform", egl.library.name())
                                         : reasons);
}

}  // namespace etalon::gpu
