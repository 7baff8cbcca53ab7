// How far a path of pairs stays behind the best pairs of the same cost, in dB.
#pragma once

#include <cstddef>
#include <optional>

#include "core/joint/exhaustive_search.h"

namespace etalon::validation {

/// gap of a point of b bits: PSNR(H(b)) − PSNR(point), H the staircase of all pairs; >= 0. A point of error 0 has gap 0; one with an error where H(b)
/// has none has no finite gap: counted, in no mean.
struct PathGaps {
  double mean_db = 0, max_db = 0;
  joint::Pair worst;  ///< the point of max_db
  std::size_t points = 0, infinite = 0;
  /// The same at 200 budgets in geometric progression from the smallest to the largest pair, the last point of the path within each budget.
  double budget_mean_db = 0, budget_max_db = 0;
};

[[nodiscard]] PathGaps path_gaps(const joint::Path& path, const joint::AllPairs& all, const joint::Staircase& staircase);

}  // namespace etalon::validation
