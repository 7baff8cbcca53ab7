// The judge in unreduced fractions of big integers; see sample.h.
#pragma once

#include "validation/reference/sample.h"

namespace etalon::validation::reference {

[[nodiscard]] std::unique_ptr<TriangleJudge> make_integer_judge(const DrawList& list, const Frame& frame, std::uint32_t t);
[[nodiscard]] TexelBytes integer_clear(const TargetSpec& target, HalfRounding half_rounding);

}  // namespace etalon::validation::reference
