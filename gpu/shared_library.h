// Libraries that are opened at run time and stay until the process ends: their worker threads do too.
#pragma once

#include <string>
#include <vector>

namespace etalon::gpu {

class SharedLibrary {
 public:
  /// The first of `names` that can be opened; else UnavailableError "OpenGL: `missing`: why the first could not".
  SharedLibrary(const std::vector<std::string>& names, const std::string& missing);

  [[nodiscard]] const std::string& name() const { return name_; }

  /// UnavailableError "OpenGL: NAME has no SYMBOL".
  template <class Function>
  void find(const char* symbol, Function& function) const {
    function = reinterpret_cast<Function>(address_of(symbol));
  }

 private:
  [[nodiscard]] void* address_of(const char* symbol) const;

  void* handle_ = nullptr;
  std::string name_;
};

}  // namespace etalon::gpu
