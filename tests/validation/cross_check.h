// The loop of the cross check: random scenes through two renderers, each difference classified. Resumable: a range of seeds, no other state.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/draw/renderer.h"
#include "tests/validation/random_scene.h"
#include "validation/texel_diff.h"

namespace etalon::test {

struct CrossCheckTotals {
  std::uint64_t first_seed = 0, next_seed = 0;
  std::array<validation::ClassCounts, kSceneKindCount> by_kind{};
  validation::ClassCounts total;
  std::array<std::uint64_t, validation::kCauseCount> unexplained_by{};
  std::array<double, kSceneKindCount> rounding_share{}, tie_share{};  ///< the largest share of a bound that was needed
  std::vector<std::string> failures;                                  ///< "seed N: sentence", the first few
};

struct CrossCheckOptions {
  std::uint64_t first_seed = 0;
  std::uint64_t texels = 20'000'000;                      ///< stops at the first seed after which so many were compared
  int largest = 512;                                      ///< texels a side
  bool exact = false;                                     ///< scenes for a renderer that keeps the contract: make_exact_scene()
  bool nearest = false;                                   ///< with `exact`: no linear filtering
  std::function<void(const CrossCheckTotals&)> progress;  ///< after each seed
};

[[nodiscard]] CrossCheckTotals cross_check(Renderer& golden, Renderer& candidate, const validation::DeviceModel& device,
                                           const CrossCheckOptions& options);

/// One line per kind of scene, and the sum.
[[nodiscard]] std::string format_totals(const CrossCheckTotals& totals);

}  // namespace etalon::test
