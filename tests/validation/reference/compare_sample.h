// One sample of one triangle: the subject's answer against the judge's.
#pragma once

#include <string>

#include "tests/validation/reference/subject.h"
#include "tests/validation/reference/tally.h"

namespace etalon::validation::reference {

/// Compares coverage, and where both cover and `with_values`, every target's bytes; adds to the tally. `label` opens a mismatch's words.
void compare_sample(const DrawList& list, const Frame& frame, std::uint32_t t, int i, int j, const TriangleJudge& judge,
                    const SampleSubject& subject, bool with_values, const std::string& label, Tally& tally);

/// The bytes of one target's texel in hexadecimal.
[[nodiscard]] std::string hex_of(const TexelBytes& bytes, int count);

/// What there is to know about triangle t: vertices with floats in hexadecimal, its draw, the state.
[[nodiscard]] std::string describe(const DrawList& list, const Frame& frame, std::uint32_t t);

}  // namespace etalon::validation::reference
