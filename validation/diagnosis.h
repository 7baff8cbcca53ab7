// What went wrong: unexplained texels are re-evaluated under the usual mistakes of a pipeline, and the mistake that explains most is named.
// Does: the mistakes of mistakes.h, and sub-texel rounding where the caller can make the scene again.
// Does not: draw; it asks the diff's own evaluation, so it needs no renderer and costs little more than the unexplained texels.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "validation/texel_diff.h"

namespace etalon::validation {

struct Hypothesis {
  std::string name;            ///< "fill rule left_ymax", "texture coordinate shifted by +1/2 texel in u", …
  double explained_share = 0;  ///< of the unexplained texels (or of an even sample of them), 0..1
};

struct DiagnosisOptions {
  std::size_t sample_limit = 65536;  ///< unexplained texels looked at, evenly spaced in row order
  /// Makes the draw list again with another rounding onto the grid; empty: that question is not asked.
  std::function<DrawList(SnapRounding)> scene_with_snap;
  /// Unexplained texels are called isolated up to this share of the frame (and at least 16), unless fill rule or sub-texel rounding explain half of them.
  double isolated_share = 1e-5;
};

/// Hypotheses sorted by share, the best first (ties: the order of usual_mistakes()); those which explain less than half are left out.
/// Empty where nothing is unexplained or nothing explains half of it. `diff` must hold its class image (InputError).
[[nodiscard]] std::vector<Hypothesis> diagnose(const DrawList& list, const Frame& frame, const DeviceModel& device,
                                               std::span<const Image> golden, std::span<const Image> candidate, const DiffResult& diff,
                                               const DiagnosisOptions& options = {});

}  // namespace etalon::validation
