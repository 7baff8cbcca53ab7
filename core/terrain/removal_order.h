// In which order the points of a height field go, so that every beginning leaves a mesh without cracks: a point never before its children.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/terrain/height_field.h"
#include "core/terrain/merge_costs.h"

namespace etalon::terrain {

enum class PruningRule {
  /// Repeatedly the merging domain of least ΔD/ΔR, ΔD the distortion that it adds (Σ of its points' costs) and ΔR its points; greedy pruning
  /// after [Balmelli, Ayer & Vetterli 1998; Balmelli, Liebling & Vetterli 2003], what [Horbelt et al.] prune with. Default.
  merging_domains,
  /// By the error of a point raised to that of its descendants (saturated), least first: levels are thresholds of it.
  saturated,
};

struct PruningOptions {
  PruningRule rule = PruningRule::merging_domains;
  std::span<const double> weights;  ///< by grid point: none for surface error in metres, screen_weights() for pixels, or any >= 0
  std::function<void(std::size_t done, std::size_t total)> progress;  ///< called now and then from one thread
};

struct RemovalOrder {
  std::vector<std::uint32_t> points;  ///< grid indices of all points but the corners, first to go first
  /// D after the first r points are gone, is the sum of the first r of these, times quantum: (weight·m)² over all grid points.
  std::vector<std::int64_t> costs;
  double quantum = 1;
};

/// O(n log n) points visited; a total order: ties go by level (finest first), then grid index; equal for every thread count. A domain's own
/// points go finest level first, then by cost. InputError as validate() and for weights that are negative or of another count.
[[nodiscard]] RemovalOrder removal_order(const HeightField& field, const PruningOptions& options = {});

}  // namespace etalon::terrain
