// The study of Soucy, Godin & Rioux as a report: tables, claims with verdicts, figures 1 to 12.
#pragma once

#include "validation/report/study_report.h"
#include "validation/studies/soucy_study.h"

namespace etalon::validation {

/// `exact` draws figure 1.
[[nodiscard]] StudyReport soucy_report(const SoucyStudyResult& result, Renderer& exact);

/// The claims alone; those on range images where there are any, those on models likewise. Each that does not hold says where and why.
[[nodiscard]] std::vector<StudyClaim> soucy_claims(const SoucyStudyResult& result);
/// The figures alone.
[[nodiscard]] std::vector<StudyFigure> soucy_figures(const SoucyStudyResult& result, Renderer& exact);

/// "1 mm", "0.25".
[[nodiscard]] std::string length_text(double length, const std::string& unit);

}  // namespace etalon::validation
