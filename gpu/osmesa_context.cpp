#include "gpu/osmesa_context.h"

#include <array>
#include <vector>

#include <fmt/core.h>

#include "core/base/error.h"
#include "gpu/shared_library.h"

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

struct Osmesa {
  explicit Osmesa(const std::string& library_path)
      : library(
            library_path.empty() ? std::vector<std::string>{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"} : std::vector{library_path},
            "OSMesa is not installed (package libosmesa6)") {
    library.find("OSMesaCreateContextAttribs", create_context);
    library.find("OSMesaDestroyContext", destroy_context);
    library.find("OSMesaMakeCurrent", make_current);
    library.find("OSMesaGetProcAddress", get_proc_address);
  }

  SharedLibrary library;
  OsmesaContextPointer (*create_context)(const int* attributes, OsmesaContextPointer shared) = nullptr;
  void (*destroy_context)(OsmesaContextPointer context) = nullptr;
  gl::Boolean (*make_current)(OsmesaContextPointer context, void* buffer, gl::Enum type, gl::Sizei width, gl::Sizei height) = nullptr;
  gl::ProcAddress (*get_proc_address)(const char* name) = nullptr;
};

class OsmesaContext final : public Context {
 public:
  explicit OsmesaContext(const std::string& library_path) : osmesa_(library_path) {
    const std::array<int, 9> attributes{
        kOsmesaFormat, kOsmesaRgba, kOsmesaProfile, kOsmesaCoreProfile, kOsmesaContextMajorVersion, 3, kOsmesaContextMinorVersion, 3, 0};
    context_ = osmesa_.create_context(attributes.data(), nullptr);
    if (context_ == nullptr) throw UnavailableError(fmt::format("OpenGL: {} gives no 3.3 core context", osmesa_.library.name()));
    try {
      make_current();
      load(osmesa_.get_proc_address);
    } catch (...) {
      osmesa_.destroy_context(context_);
      throw;
    }
  }

  ~OsmesaContext() override { osmesa_.destroy_context(context_); }

  void make_current() override {
    if (osmesa_.make_current(context_, default_framebuffer_.data(), gl::kUnsignedByte, kDefaultSize, kDefaultSize) == 0) {
      throw UnavailableError(fmt::format("OpenGL: {}: the context cannot be made current", osmesa_.library.name()));
    }
  }

  std::string origin() const override { return fmt::format("OSMesa ({})", osmesa_.library.name()); }

 private:
  // OSMesa wants a default framebuffer; all drawing goes to framebuffer objects, so it may be tiny.
  static constexpr int kDefaultSize = 4;
  std::array<unsigned char, 4 * kDefaultSize * kDefaultSize> default_framebuffer_{};
  Osmesa osmesa_;
  OsmesaContextPointer context_ = nullptr;
};

}  // namespace

std::unique_ptr<Context> make_osmesa_context(const std::string& library_path) { return std::make_unique<OsmesaContext>(library_path); }

}  // namespace etalon::gpu
