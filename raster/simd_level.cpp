#include "raster/simd_level.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>

#include "core/base/error.h"
#include "raster/fast/kernels.h"

namespace etalon::raster {
namespace {

constexpr std::array<std::string_view, 6> kNames = {"baseline", "ssse3", "sse4", "avx2", "avx512", "neon"};

std::atomic<int> chosen_level{-1};

}  // namespace

std::vector<SimdLevel> available_simd_levels() {
  std::vector<SimdLevel> levels;
  for (std::size_t n = 0; n < kNames.size(); ++n)
    if (fast::kernels_for(static_cast<SimdLevel>(n)) != nullptr) levels.push_back(static_cast<SimdLevel>(n));
  return levels;
}

void set_simd_level(SimdLevel level) {
  const auto levels = available_simd_levels();
  if (std::find(levels.begin(), levels.end(), level) == levels.end())
    throw InputError(fmt::format("SIMD level: {} is not available here", to_string(level)));
  chosen_level = static_cast<int>(level);
}

SimdLevel simd_level() {
  static const SimdLevel best = available_simd_levels().back();
  const int level = chosen_level;
  return level < 0 ? best : static_cast<SimdLevel>(level);
}

std::string to_string(SimdLevel level) { return std::string(kNames[static_cast<std::size_t>(level)]); }

std::optional<SimdLevel> parse_simd_level(std::string_view name) {
  for (std::size_t n = 0; n < kNames.size(); ++n)
    if (kNames[n] == name) return static_cast<SimdLevel>(n);
  return std::nullopt;
}

}  // namespace etalon::raster
