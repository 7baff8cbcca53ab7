#include "gpu/osmesa_context.h"

#include <array>
#include <vector>

#include <dlfcn.h>
#include <fmt/core.h>

#include "core/base/error.h"

namespace etalon::gpu {

namespace {

// From Mesa's GL/osmesa.h; OSMesaContext is a pointer to an opaque struct, the buffer an array of 4 channels.
using OsmesaContextPointer = void*;
constexpr int kOsmesaFormat = 0x22;
constexpr int kOsmesaRgba = 0x1908;
constexpr int kOsmesaProfile = 0x33;
constexpr int kOsmesaCoreProfile = 0x34;
constexpr int kOsmesaContextMajorVersion = 0x36;
constexpr int kOsmesaContextMinorVersion = 0x37;

struct OsmesaLibrary {
  std::string path;
  OsmesaContextPointer (*create_context)(const int* attributes, OsmesaContextPointer shared) = nullptr;
  void (*destroy_context)(OsmesaContextPointer context) = nullptr;
  gl::Boolean (*make_current)(OsmesaContextPointer context, void* buffer, gl::Enum type, gl::Sizei width, gl::Sizei height) = nullptr;
  gl::ProcAddress (*get_proc_address)(const char* name) = nullptr;
};

template <class Function>
void find_symbol(void* handle, const std::string& path, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(handle, name));
  if (function == nullptr) throw UnavailableError(fmt::format("OpenGL: {} has no {}", path, name));
}

OsmesaLibrary open_library(const std::string& library_path) {
  const std::vector<std::string> paths =
      library_path.empty() ? std::vector<std::string>{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"} : std::vector{library_path};
  std::string first_reason;
  for (const std::string& path : paths) {
    void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) {
      const char* reason = dlerror();
      if (first_reason.empty()) first_reason = reason != nullptr ? reason : path;
      continue;
    }
    OsmesaLibrary library;
    library.path = path;
    find_symbol(handle, path, "OSMesaCreateContextAttribs", library.create_context);
    find_symbol(handle, path, "OSMesaDestroyContext", library.destroy_context);
    find_symbol(handle, path, "OSMesaMakeCurrent", library.make_current);
    find_symbol(handle, path, "OSMesaGetProcAddress", library.get_proc_address);
    return library;
  }
  throw UnavailableError(fmt::format("OpenGL: OSMesa is not installed (package libosmesa6): {}", first_reason));
}

class OsmesaContext final : public Context {
 public:
  explicit OsmesaContext(const std::string& library_path) : library_(open_library(library_path)) {
    const std::array<int, 9> attributes{
        kOsmesaFormat, kOsmesaRgba, kOsmesaProfile, kOsmesaCoreProfile, kOsmesaContextMajorVersion, 3, kOsmesaContextMinorVersion, 3, 0};
    context_ = library_.create_context(attributes.data(), nullptr);
    if (context_ == nullptr) throw UnavailableError(fmt::format("OpenGL: {} gives no 3.3 core context", library_.path));
    try {
      make_current();
      load(library_.get_proc_address);
    } catch (...) {
      library_.destroy_context(context_);
      throw;
    }
  }

  ~OsmesaContext() override { library_.destroy_context(context_); }

  void make_current() override {
    if (library_.make_current(context_, default_framebuffer_.data(), gl::kUnsignedByte, kDefaultSize, kDefaultSize) == 0) {
      throw UnavailableError(fmt::format("OpenGL: {}: the context cannot be made current", library_.path));
    }
  }

  std::string origin() const override { return fmt::format("OSMesa ({})", library_.path); }

 private:
  // OSMesa wants a default framebuffer; all drawing goes to framebuffer objects, so it may be tiny.
  static constexpr int kDefaultSize = 4;
  std::array<unsigned char, 4 * kDefaultSize * kDefaultSize> default_framebuffer_{};
  OsmesaLibrary library_;
  OsmesaContextPointer context_ = nullptr;
};

}  // namespace

std::unique_ptr<Context> make_osmesa_context(const std::string& library_path) { return std::make_unique<OsmesaContext>(library_path); }

}  // namespace etalon::gpu
