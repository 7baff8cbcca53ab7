// What the tables and claims of studies have in common: cells, rows of texel classes, verdicts by counting, lists in a sentence.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/report/study_report.h"
#include "validation/texel_diff.h"

namespace etalon::validation {

[[nodiscard]] StudyCell word_cell(const std::string& text);
/// above / below; nothing where `below` is not above 0.
[[nodiscard]] std::optional<double> quotient(double above, double below);
/// A part in percent; "–" of nothing.
[[nodiscard]] StudyCell percent_cell(double part, double whole, int digits);

/// Columns of a row of texel classes, and the row's cells: texels, identical, rounding, tie, unbounded, unexplained.
[[nodiscard]] std::vector<std::string> class_columns();
[[nodiscard]] std::vector<StudyCell> class_cells(const ClassCounts& counts);

/// A claim judged case by case: it holds where it does in all, partly where it does in some.
struct CaseCount {
  int held = 0, all = 0;
  void add(bool holds);
  [[nodiscard]] ClaimVerdict verdict() const;  ///< of no case at all: fails
};

/// "a; b", and "; …" where there are more than `most`.
[[nodiscard]] std::string listed(const std::vector<std::string>& items, std::size_t most = 8);

}  // namespace etalon::validation
