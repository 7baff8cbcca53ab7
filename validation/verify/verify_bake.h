// The job `bake`: the model as few triangles with its colours in a texture map, drawn by nearest lookup by both sides.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/draw/renderer.h"
#include "validation/verify/verify.h"

namespace etalon::validation {

inline constexpr const char* kNoColors =
    "neither vertex colours nor a texture with coordinates to take them from (try a coloured scan, or `etalon make duck -o duck.ply`)";

/// One scene each of two opposite views of the 24. What is baked are the model's vertex colours; where it has none, its texture at the vertices
/// (texture_at_vertices()). Both sides get the same triangles and the same map. Skipped where there are no colours, or where baking is refused.
/// `progress` hears of faces removed. `frame` is one the device draws. InputError: the view is degenerate, the model breaks the contract's ranges.
struct BakeCases {
  std::string skipped;  ///< why there are none
  std::vector<CaseResult> cases;
};
[[nodiscard]] BakeCases bake_cases(const VerifyModel& model, const Frame& frame, Renderer& exact, const VerifyDevice& device,
                                   const VerifyOptions& options, const std::function<void(std::size_t done, std::size_t total)>& progress);

}  // namespace etalon::validation
