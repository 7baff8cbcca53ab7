// Which vector instructions the fast path uses. The bytes do not depend on it (docs/decisions/0005-fast-path.md); the time does.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace etalon::raster {

/// From worst to best within an architecture. `baseline` is what the compiler makes of Highway's portable vectors without dispatch: SSE2
/// on x86-64.
enum class SimdLevel : std::uint8_t { baseline, ssse3, sse4, avx2, avx512, neon };

/// What this machine and this build can run, worst to best; never empty.
[[nodiscard]] std::vector<SimdLevel> available_simd_levels();

/// The level of later renders in this process; the best available one until it is set. InputError where it is not available.
void set_simd_level(SimdLevel level);
[[nodiscard]] SimdLevel simd_level();

[[nodiscard]] std::string to_string(SimdLevel level);
[[nodiscard]] std::optional<SimdLevel> parse_simd_level(std::string_view name);

}  // namespace etalon::raster
