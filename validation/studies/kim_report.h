// The study of Kim, Choi & Lee as a report: tables 1 to 3 beside the paper's, claims with verdicts, figures.
#pragma once

#include "validation/report/study_report.h"
#include "validation/studies/kim_study.h"

namespace etalon::validation {

[[nodiscard]] StudyReport kim_report(const KimStudyResult& result);

/// The claims alone, judged at the default unit against half-edge and full-edge `qem6`: a claim holds where it does so for every subject and
/// both, partly where it does so for some. Each that does not hold says where it fails and what the sweep over units shows about why.
[[nodiscard]] std::vector<StudyClaim> kim_claims(const KimStudyResult& result);

}  // namespace etalon::validation
