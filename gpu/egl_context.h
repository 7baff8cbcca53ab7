// Context from EGL without a surface: a GPU where there is one, else Mesa's software rasterizer, the one that OSMesa has too.
#pragma once

#include <memory>

#include "gpu/context.h"

namespace etalon::gpu {

/// Where options.driver names one of Mesa's rasterizers, the surfaceless platform with it; else the devices that EGL lists, hardware before
/// software, the first that gives a 3.3 core context; then the surfaceless platform. library_path as in ContextOptions.
[[nodiscard]] std::unique_ptr<Context> make_egl_context(const ContextOptions& options);

}  // namespace etalon::gpu
