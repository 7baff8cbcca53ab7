// The map update of texture adaptation [Chen & Chuang 2006, sec. 3]: each edge collapse re-maps a fan of triangles from the map as it was
// into the map as it will be.
#pragma once

#include <cstdint>

#include "tests/bench/bench_scene.h"

namespace etalon::bench {

inline constexpr std::uint32_t kFanTriangles = 10;

/// Decagons of about 105 texels, each warped by less than a texel, from one RG32F 1024 × 1024 map into another, nearest, affine, without
/// depth. A collapse reads what earlier ones wrote, so a device goes back and forth between two maps. For its result to be that of a
/// single pass from a map that never changes, even fans keep to the left half of the maps and odd ones to the right, in positions and
/// in coordinates: going from map A to B with the left fans and from B to A with the right ones, nothing is read that was written.
/// Fan k has the triangles 10k … 10k + 9.
[[nodiscard]] BenchScene fan_scene(std::uint32_t fan_count = 10'000);

}  // namespace etalon::bench
