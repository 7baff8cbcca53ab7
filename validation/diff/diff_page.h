// The page of `etalon diff`: one file, no outside resources; a slider, a heat map, the class map, a histogram and the worst texels of each pair that differs.
#pragma once

#include <string>
#include <vector>

#include "validation/diff/pair_diff.h"
#include "validation/report/run_info.h"

namespace etalon::validation {

/// Pairs must have been compared with pictures (PairOptions::picture_px).
[[nodiscard]] std::string diff_page(const std::vector<PairResult>& pairs, const PixelThresholds& thresholds, const RunInfo& run);

}  // namespace etalon::validation
