// The exact renderer's resident map: each group of a pass is drawn as tiles of its own, into a copy, and what it covered is copied back.
#pragma once

#include <memory>

#include "core/draw/resident_map.h"

namespace etalon::raster {

/// As Renderer::make_map. Bytes are those of CpuRenderer::render() on each pass's list (tests/raster/cpu_map_test.cpp).
[[nodiscard]] std::unique_ptr<ResidentMap> make_cpu_map(Image map, const MapState& state);

}  // namespace etalon::raster
