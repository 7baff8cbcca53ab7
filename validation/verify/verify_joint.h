// The job `joint` of `verify`: a small terrain and its image as pairs of levels, from the smallest to the full one, on the exact rasterizer and on
// a device: each mesh drawn into its texture coordinates, each pair's texture looked up through the exact ones [Horbelt, Balmelli & Vetterli].
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "validation/verify/verify.h"

namespace etalon::validation {

struct JointCases {
  std::string skipped;  ///< why there are none: a frame so small that it shows nothing
  std::vector<CaseResult> cases;
};

/// 33² heights and 128² texels of `etalon make terrain`, whatever the models; at most 512 texels of the frame in each direction.
[[nodiscard]] JointCases joint_cases(Renderer& exact, const VerifyDevice& device, const VerifyOptions& options,
                                     const std::function<void(std::size_t done, std::size_t total)>& progress);

}  // namespace etalon::validation
