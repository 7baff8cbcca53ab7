// One scene of `verify`: drawn twice, compared, pictured.
#pragma once

#include <functional>

#include "core/draw/draw_list.h"
#include "validation/texel_diff.h"
#include "validation/verify/drawn_pair.h"
#include "validation/verify/verify.h"

namespace etalon::validation {

/// Fills the measurements, classes and pictures of `item`, whose names are set already. `frame.state` must be one the device draws with.
/// `scene_with_snap` makes the list again with another rounding onto the grid, for the diagnosis of unexplained texels; may be empty.
/// UnavailableError: the device cannot draw this frame.
void compare_case(CaseResult& item, const DrawList& list, const Frame& frame, Renderer& exact, const VerifyDevice& device,
                  const VerifyOptions& options, const std::function<DrawList(SnapRounding)>& scene_with_snap = {});

/// Tally, diagnosis, worst texels and class picture of a pair that is drawn already, with its pictures, both sides of every target.
DiffResult classify_case(CaseResult& item, const DrawnPair& pair, const DrawList& list, const Frame& frame, const DeviceModel& model,
                         const VerifyOptions& options, int reach, const std::function<DrawList(SnapRounding)>& scene_with_snap = {});

}  // namespace etalon::validation
