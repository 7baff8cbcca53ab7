// The study of Chen & Chuang as a report: PSNR, Table 1 beside the paper's, claims with verdicts, figures.
#pragma once

#include "validation/report/study_report.h"
#include "validation/studies/chen_study.h"

namespace etalon::validation {

[[nodiscard]] StudyReport chen_report(const ChenStudyResult& result);

/// The claims alone: a claim on all models holds where it does so for every level and texture of each, partly where it does so for some.
[[nodiscard]] std::vector<StudyClaim> chen_claims(const ChenStudyResult& result);

/// The paper's figures 1 to 15 for these subjects, those that they can show.
[[nodiscard]] std::vector<StudyFigure> chen_figures(const ChenStudyResult& result);

}  // namespace etalon::validation
