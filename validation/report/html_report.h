// The page a person looks at: one file, no outside resources, works from file://, light and dark, with keyboard and screen reader.
// For each scene: a slider between both renderers, the class image, the error heat map, figures, the worst texels; then where it was run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validation/report/run_info.h"
#include "validation/verify/verify_result.h"

namespace etalon::validation {

/// The whole page. `run` feeds the section "This run" only.
[[nodiscard]] std::string verify_page(const VerifyResult& result, const RunInfo& run);

/// Writes index.html, verify.json and classes.csv into `folder` (made where it does not exist, with its parents): all are complete on the
/// disk before the first takes its place. Returns the path of index.html. WriteError where the folder or a file cannot be written.
std::filesystem::path write_verify_report(const std::filesystem::path& folder, const VerifyResult& result, const RunInfo& run);

/// "file:///…" of an absolute path, percent-encoded (RFC 3986), so that terminals make it a link.
[[nodiscard]] std::string file_url(const std::filesystem::path& path);

}  // namespace etalon::validation
