// The judge in reduced rationals, written from docs/contract.md without a look at the integer one; see sample.h.
#pragma once

#include "validation/reference/sample.h"

namespace etalon::validation::reference {

[[nodiscard]] std::unique_ptr<TriangleJudge> make_rational_judge(const DrawList& list, const Frame& frame, std::uint32_t t);
[[nodiscard]] TexelBytes rational_clear(const TargetSpec& target, HalfRounding half_rounding);

}  // namespace etalon::validation::reference
