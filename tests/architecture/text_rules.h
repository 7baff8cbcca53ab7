// Rules on the text of the sources: determinism (docs/contract.md#determinism), size, names, unfinished work.
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_text.h"

namespace etalon::test {

/// A place that may break a rule, and why. One that is not needed any more is reported.
struct Exemption {
  std::string path;
  std::string rule;
  std::string reason;
};

/// Violations, per file, of:
///   "libm"          no sin cos tan pow exp log … outside tests/: they differ between C libraries
///   "random"        no <random> and no rand(): std distributions are not specified bit for bit
///   "unordered"     no std::unordered_…: its iteration order is nobody's promise
///   "fast math"     no pragma or attribute that lets the compiler change a floating-point value
///   "pragma once"   every header has it
///   "size"          at most 600 lines, *_table.inc excepted
///   "file name"     snake_case
///   "unfinished"    no mark of unfinished work
[[nodiscard]] std::vector<Violation> check_text(const SourceFile& file);

/// check_text over all files, without what is exempted; an exemption that exempts nothing is a violation ("unused exemption").
[[nodiscard]] std::vector<Violation> check_texts(const std::vector<SourceFile>& files, const std::vector<Exemption>& exemptions);

}  // namespace etalon::test
