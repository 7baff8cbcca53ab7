#include "validation/studies/study_tables.h"

#include <algorithm>

namespace etalon::validation {

StudyCell word_cell(const std::string& text) { return {text, {}}; }

std::optional<double> quotient(double above, double below) { return below > 0 ? std::optional<double>(above / below) : std::nullopt; }

StudyCell percent_cell(double part, double whole, int digits) { return number_cell(quotient(100 * part, whole), digits); }

std::vector<std::string> class_columns() { return {"texels", "identical", "rounding", "tie", "unbounded", "unexplained"}; }

std::vector<StudyCell> class_cells(const ClassCounts& counts) {
  std::vector<StudyCell> cells{count_cell(counts.total())};
  for (const TexelClass c : {TexelClass::identical, TexelClass::rounding, TexelClass::tie, TexelClass::unbounded, TexelClass::unexplained})
    cells.push_back(count_cell(counts[c]));
  return cells;
}

void CaseCount::add(bool holds) {
  ++all;
  held += holds;
}

ClaimVerdict CaseCount::verdict() const {
  if (held == 0) return ClaimVerdict::fails;
  return held == all ? ClaimVerdict::holds : ClaimVerdict::partly;
}

std::string listed(const std::vector<std::string>& items, std::size_t most) {
  std::string text;
  for (std::size_t n = 0; n < std::min(items.size(), most); ++n) text += (n > 0 ? "; " : "") + items[n];
  return items.size() > most ? text + "; …" : text;
}

}  // namespace etalon::validation
