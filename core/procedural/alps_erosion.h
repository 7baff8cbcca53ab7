// A mountain range that rivers carve while it rises: the relief of make_alps on a grid.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/math/vec.h"

namespace etalon::procedural {

/// Numbers by cell of a grid of kReliefSize², row 0 in the south; the terrain is the middle kReliefInner², the rest keeps its border away.
inline constexpr int kReliefSize = 337, kReliefInner = 257, kReliefMargin = (kReliefSize - kReliefInner) / 2;
inline constexpr double kReliefSpacing_m = 20;

struct Relief {
  std::vector<double> height_m;
  std::vector<double> flow;  ///< cells that drain through a cell, itself included
  std::vector<double> lake;  ///< 1 in the lake, else 0
  std::vector<Vec2d> river;  ///< the main river's cells within the inner square, downstream, in cells of the inner square
  double lake_level_m = 0;
};

/// Stream power erosion under steady uplift, solved implicitly downstream first [Braun & Willett 2013]; water goes down the
/// steepest of eight directions, by chance not quite (Rho8 [Fairfield & Leymarie 1991], so that no direction shows), and out of hollows by flooding from the
/// border [Barnes, Lehman & Mulla 2014]; slopes are cut to a talus. Only + − × ÷ √ and comparisons, one thread.
[[nodiscard]] Relief make_relief(std::uint64_t seed, const std::function<void(int done, int total)>& progress);

}  // namespace etalon::procedural
