// What it costs to take a point away: the distortion of merging the triangles that it splits, exactly additive over points.
//
// The mesh of any level consists of triangles of the hierarchy, so its distortion D = Σ over grid points of (weight·(height − surface))² is the
// sum of E(T) over its triangles, grid points on an edge counted half on either side. Taking a point v away, its children gone, replaces four
// triangles by two; so D of a level is Σ cost(v) over the points that it lacks, in whatever order they went:
//     cost(v) = Σ over the one or two triangles T with v in the middle of the longest side of (E(T) − E(T's halves)).
// A cost can be negative. All E(T) take O(n log n): each of the 2k levels visits every grid point once or twice.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/terrain/height_field.h"

namespace etalon::terrain {

struct MergeCosts {
  /// By grid point, in multiples of `quantum`; 0 for the corners. Σ|cost| < 2^62, so that any sum of them is exact.
  std::vector<std::int64_t> costs;
  /// (weight·metre)² of one step: a power of two.
  double quantum = 1;
};

/// Weights by grid point, >= 0, finite; none: all 1 (surface error; D is then in m²). E(T) is summed in double in a fixed order (row by row) and
/// each cost rounded once to a multiple of Σ|cost|·2^-61 or so. Equal for every thread count. InputError for weights of another count, or < 0.
[[nodiscard]] MergeCosts merge_costs(const HeightField& field, std::span<const double> weights = {});

/// Distance in height between a point and the middle of the edge that it splits, times its weight, by grid point: metres, or pixels with weights
/// from screen_weights(). 0 for the corners.
[[nodiscard]] std::vector<double> split_errors(const HeightField& field, std::span<const double> weights = {});

}  // namespace etalon::terrain
