// The flight of study horbelt as a figure and a table.
#pragma once

#include "validation/report/study_report.h"
#include "validation/studies/horbelt_study.h"

namespace etalon::validation {

/// A film of the frames with their PSNR and the share of the mesh as curves, and all of them on one sheet. `subject.flight` has frames.
[[nodiscard]] StudyFigure flight_figure(const HorbeltSubjectResult& subject);

/// Pair, bits and PSNR of each frame. No rows where there was no flight.
[[nodiscard]] StudyTable flight_table(const HorbeltStudyResult& result);

}  // namespace etalon::validation
