// The documents of the command line: `etalon/verify/1` here, and the head that every document shares (docs/schemas).
// Everything outside the object `run` is the same bytes for the same input, whatever machine, thread count or time of day.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "validation/report/run_info.h"
#include "validation/verify/verify_result.h"

namespace etalon::validation {

/// {schema: "etalon/VERB/1", contract, inputs: [{name, role, sha256, attribution?}]}; the caller adds its own members, then `run`.
[[nodiscard]] nlohmann::ordered_json document_head(const std::string& verb, const std::vector<VerifyInput>& inputs);

/// Two spaces of indentation and a final newline; bytes that are not UTF-8 (file names) are replaced by U+FFFD.
[[nodiscard]] std::string to_text(const nlohmann::ordered_json& document);

/// `etalon/verify/1`.
[[nodiscard]] nlohmann::ordered_json verify_document(const VerifyResult& result, const RunInfo& run);

/// The class table as CSV: one line per scene, then one per job, then the total. RFC 4180, "\r\n".
[[nodiscard]] std::string verify_csv(const VerifyResult& result);

/// The class table for a terminal, one string a line: a scene a line, then the total, then the caveats.
[[nodiscard]] std::vector<std::string> verify_table(const VerifyResult& result);

/// 1234567 → "1,234,567".
[[nodiscard]] std::string grouped(std::uint64_t count);

}  // namespace etalon::validation
