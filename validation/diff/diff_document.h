// What `etalon diff` found, for programs and for a terminal: `etalon/diff/1`, JUnit XML, lines of text.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "validation/diff/pair_diff.h"
#include "validation/report/run_info.h"

namespace etalon::validation {

/// `etalon/diff/1`; `inputs` are those beside the pairs' own files.
[[nodiscard]] nlohmann::ordered_json diff_document(const std::vector<PairResult>& pairs, const PixelThresholds& thresholds,
                                                   const std::vector<VerifyInput>& inputs, const RunInfo& run);

/// One test case a pair: a failure where it differs, an error where it could not be read; times are left out, so that the same input gives the same bytes.
[[nodiscard]] std::string diff_junit(const std::vector<PairResult>& pairs, const PixelThresholds& thresholds,
                                     const std::vector<std::string>& unused_waivers);

/// What a person reads of a pair, a line each, without its name.
[[nodiscard]] std::vector<std::string> pair_lines(const PairResult& pair, const PixelThresholds& thresholds);

}  // namespace etalon::validation
