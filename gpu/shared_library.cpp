#include "gpu/shared_library.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include "core/base/error.h"

namespace etalon::gpu {

SharedLibrary::SharedLibrary(const std::vector<std::string>& names, const std::string& missing) {
  std::string first_reason;
  for (const std::string& name : names) {
    handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    name_ = name;
    if (handle_ != nullptr) return;
    const char* reason = dlerror();
    if (first_reason.empty()) first_reason = reason != nullptr ? reason : name;
  }
  throw UnavailableError(fmt::format("OpenGL: {}: {}", missing, first_reason));
}

void* SharedLibrary::address_of(const char* symbol) const {
  void* const address = dlsym(handle_, symbol);
  if (address == nullptr) throw UnavailableError(fmt::format("OpenGL: {} has no {}", name_, symbol));
  return address;
}

}  // namespace etalon::gpu
