// The outcome of a study as a page of documentation: claims, tables, when and where it was measured; figures last.
#pragma once

#include <string>

#include "validation/report/run_info.h"
#include "validation/report/study_report.h"

namespace etalon::validation {

/// Markdown. `command`: what to type to repeat it; `measured`: when and on what machine (measured_on()). Folded tables are left out.
/// Figures name the files of write_study().
[[nodiscard]] std::string study_markdown(const StudyReport& report, const RunInfo& run, const std::string& command,
                                         const std::string& measured);

/// The name of the file that a figure's drawing is written as.
[[nodiscard]] std::string study_drawing_file(const StudyFigure& figure);

/// "2026-11-22, Intel(R) Xeon(R) CPU @ 2.00GHz, 2 threads": the date in UTC, the processor as Linux names it ("unknown processor" elsewhere).
[[nodiscard]] std::string measured_on(const RunInfo& run);

}  // namespace etalon::validation
