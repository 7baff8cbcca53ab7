// The files of a study: one folder with index.html (self-contained), study.json, study.md, a CSV file a table, a PNG
// file a picture, an SVG file a drawing.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "validation/report/run_info.h"
#include "validation/report/study_report.h"

namespace etalon::validation {

/// `etalon/study/1`. Times, and claims that rest on them, are in `run`; the rest is the same bytes for the same input.
[[nodiscard]] nlohmann::ordered_json study_document(const StudyReport& report, const RunInfo& run);

/// RFC 4180, "\r\n"; numbers with nine digits, '.' as the point.
[[nodiscard]] std::string study_csv(const StudyTable& table);

/// The page: no outside resources, light and dark.
[[nodiscard]] std::string study_page(const StudyReport& report, const RunInfo& run);

/// The names of the files that write_study would write into its folder, index.html last.
[[nodiscard]] std::vector<std::string> study_files(const StudyReport& report);

/// Writes all of them (the folder is made where it does not exist): all are complete on the disk before the first takes its place. `command`:
/// what to type to repeat it (study_markdown.h). Returns the path of index.html. WriteError.
std::filesystem::path write_study(const std::filesystem::path& folder, const StudyReport& report, const RunInfo& run,
                                  const std::string& command);

}  // namespace etalon::validation
