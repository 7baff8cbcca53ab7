// The two images of each target of a drawing, and what a page shows of them.
#pragma once

#include <string>
#include <vector>

#include "core/draw/state.h"
#include "validation/texel_diff.h"
#include "validation/verify/verify_result.h"

namespace etalon::validation {

/// Both sides of a scene, and what they look like.
struct DrawnPair {
  std::vector<Image> cpu, gl;                  // one per target; gl empty without a device
  std::vector<Image> cpu_picture, gl_picture;  // full size
};

/// Makes the pictures.
void picture_targets(DrawnPair& pair, const Frame& frame);

/// The target with its measurements and its pictures, at most `picture_px` a side; a difference is seen from `reach` texels around.
[[nodiscard]] TargetResult measure_target(const DrawnPair& pair, std::size_t t, const TargetSpec& spec, int picture_px, int reach);

/// A mark must survive the reduction of its picture, which keeps one texel of a step, and be seen where the page shows it some 340 px wide.
[[nodiscard]] int mark_reach(const Frame& frame, int picture_px);

/// What the page says of up to `count` of the texels that a diff describes: the worst first, but what is explained shares the room: of
/// unbounded texels and of ties at most half each, of roundings one.
[[nodiscard]] std::vector<WorstTexel> worst_texels(const DiffResult& diff, const DrawnPair& pair, const std::vector<TargetSpec>& targets,
                                                   int count);

[[nodiscard]] ClassTally tally_of(const ClassCounts& counts);

/// The channels of texel (x, y) as stored: "120 44 31 255", "0.5123458", "-" for no triangle.
[[nodiscard]] std::string texel_text(const Image& image, int x, int y);

}  // namespace etalon::validation
