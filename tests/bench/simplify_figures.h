// What the project wants of the simplification scenes.
#pragma once

#include "tests/bench/simplify_bench.h"

namespace etalon::bench {

/// A published pair of distances of the knot of 100,000 faces at 10 %, measured by Hoppe's MeshDistance with 100,000 random samples each way.
struct ColourRow {
  const char* title;
  double rms_percent, colour_rms;
};
[[nodiscard]] const std::vector<ColourRow>& published_colour_rows();

/// What vcglib's `metro -n1000000` said of that knot and a rival's result: the larger direction, in % of Metro's own diagonal.
struct MetroRow {
  const char *way, *title;
  double rms_percent, mean_percent;
};
[[nodiscard]] const std::vector<MetroRow>& metro_rows();

/// The scene that both are of.
inline constexpr const char* kPublishedScene = "simplify-knot100k";

/// How many rows are better than (rms, colour) in both: rms as a share of the diagonal.
[[nodiscard]] std::size_t rows_better_in_both(double rms, double colour_rms);

/// The figures that the result's ways allow, in a fixed order; those of a rival that is absent are skipped with its reason.
[[nodiscard]] std::vector<Figure> figures_of(const SimplifySceneResult& result);

}  // namespace etalon::bench
