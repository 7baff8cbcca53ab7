// Which unexplained texels a person should see: the largest differences, from different places.
#pragma once

#include <vector>

#include "core/draw/draw_list.h"
#include "validation/bounds.h"
#include "validation/texel_diff.h"
#include "validation/verify/drawn_pair.h"

namespace etalon::validation {

/// At most `count`, by falling difference of the first target (ties: row by row), none within kCropSize / 2 texels of another. Empty where none is.
[[nodiscard]] std::vector<TexelReport> worst_unexplained(const DiffResult& diff, const DrawnPair& pair, const DrawList& list,
                                                         const Frame& frame, const DeviceModel& model, int count);

}  // namespace etalon::validation
