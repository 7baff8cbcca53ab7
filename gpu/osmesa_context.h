// Context on Mesa's off-screen library, found with dlopen.
#pragma once

#include <memory>
#include <string>

#include "gpu/context.h"

namespace etalon::gpu {

/// `library_path` as in ContextOptions.
[[nodiscard]] std::unique_ptr<Context> make_osmesa_context(const std::string& library_path);

}  // namespace etalon::gpu
