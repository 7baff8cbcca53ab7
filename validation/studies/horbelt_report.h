// The study of Horbelt, Balmelli & Vetterli as a report: gaps of every method, claims with verdicts, Figures 1 to 6.
#pragma once

#include "validation/report/study_report.h"
#include "validation/studies/horbelt_study.h"

namespace etalon::validation {

[[nodiscard]] StudyReport horbelt_report(const HorbeltStudyResult& result);

/// The claims alone. Thresholds: mean gap 0.3 dB on every view; worst 1.0 dB on four of five views of a subject and 1.5 dB on all.
[[nodiscard]] std::vector<StudyClaim> horbelt_claims(const HorbeltStudyResult& result);

/// The file of a view (`etalon/view/1`) in the study's folder: "alps-valley-view.json".
[[nodiscard]] std::string horbelt_view_file(const std::string& subject, const std::string& view);

}  // namespace etalon::validation
