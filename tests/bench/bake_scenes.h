// The scenes of baking, as etalon_bench runs them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/bench/bake_bench.h"
#include "tests/bench/bench_options.h"

namespace etalon::bench {

/// Names and titles, in order.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> bake_scene_titles();

struct BakeScenes {
  BakeBenchResult result;
  std::size_t measured = 0;
  std::vector<std::string> absent;  ///< scenes whose real input is not there
};
/// Those that the options ask for; `program`: etalon.
[[nodiscard]] BakeScenes measure_bake_scenes(const BenchOptions& options, const std::string& program);

}  // namespace etalon::bench
