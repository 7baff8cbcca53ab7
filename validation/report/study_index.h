// Several studies as one: what a reader of all the papers wants first, each study's own page one link away.
#pragma once

#include "validation/report/study_report.h"

namespace etalon::validation {

/// An index without studies, to be written (study_page.h) into the folder above theirs.
[[nodiscard]] StudyReport make_study_index();

/// Adds a study whose files are in the folder `report.name` beside the index: a row of counts, every claim with what was measured and its
/// verdict, the first pictures, links to its page and its tables. Claims that rest on times stay apart, as everywhere.
void add_to_index(StudyReport& index, const StudyReport& report);

}  // namespace etalon::validation
