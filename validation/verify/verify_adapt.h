// The job `adapt`: an indexing map goes down a progressive mesh and up again, and every pass is drawn by both sides.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/draw/renderer.h"
#include "validation/verify/verify.h"

namespace etalon::validation {

inline constexpr const char* kNoTextureCoordinates =
    "no texture coordinates (try a model that has them, or `etalon make head -o head.obj`)";

/// One scene a filter. A pass is drawn twice by the device: from the map as the exact renderer has made it, so that each step stands alone, and from
/// the map as the device itself has made it. In either case the exact renderer starts from the same map as the device, so every texel
/// of the device's own way down and up is explained step by step. The tally counts the texels that passes cover, in both ways; texels that
/// only one side covers count too. Beside that the device's resident map (Renderer::make_map) must hold what its drawings gave: a texel that
/// does not is unexplained.
/// Skipped where the mesh has no texture coordinates, where it cannot be simplified or where no split has cells. `progress` hears of passes done and
/// in all, of both filters.
struct AdaptCases {
  std::string skipped;  ///< why there are none
  std::vector<CaseResult> cases;
};
[[nodiscard]] AdaptCases adapt_cases(const VerifyModel& model, Renderer& exact, const VerifyDevice& device, const VerifyOptions& options,
                                     const std::function<void(std::size_t done, std::size_t total)>& progress);

}  // namespace etalon::validation
