#include "tests/architecture/text_rules.h"

#include <algorithm>
#include <regex>
#include <sstream>

namespace etalon::test {
namespace {

constexpr int kMaxLines = 600;

struct Pattern {
  std::string rule;
  std::regex regex;
  std::string advice;
  bool in_comments = false;  ///< searched in the whole text, not only in the code
  bool in_tests = true;
};

// The marks are put together from halves, or this file would convict itself.
const std::vector<Pattern>& patterns() {
  static const std::vector<Pattern> kPatterns = {
      {"libm",
       // A call: at the start of a line, after an operator (-> and . apart) or `return`; `std::string log(text)` declares a variable.
       std::regex(
           R"((^\s*|[^\w\s.>:]\s*|\s>\s*|\breturn\s+|\bstd::|(^|[^\w>])::)(a?(sin|cos|tan)h?|atan2|sincos|pow|exp|exp2|exp10|expm1|log|log2|log10|log1p|cbrt|hypot|[tl]gamma|erfc?)[fl]?\s*\()"),
       "differs between C libraries", false, false},
      {"random", std::regex(R"(#\s*include\s*<random>|\b(s?rand|drand48|random)\s*\(|std::shuffle|std::random_)"), "use core/base/rng.h"},
      {"unordered", std::regex(R"(\bunordered_(multi)?(map|set)\b)"), "use a sorted vector or std::map", false, false},
      {"fast math", std::regex(R"(#\s*pragma\s+(STDC\s+FP_CONTRACT\s+ON|GCC\s+optimize|clang\s+fp)|fast-math|__builtin_assoc_barrier)"),
       "no compiler may change a value"},
      {"unfinished",
       std::regex("\\b(TO"
                  "DO|FIX"
                  "ME|XX"
                  "X|HA"
                  "CK)\\b"),
       "finish it or file it", true},
  };
  return kPatterns;
}

void search(const SourceFile& file, const std::string& text, const Pattern& pattern, std::vector<Violation>& out) {
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number)
    if (std::smatch match; std::regex_search(line, match, pattern.regex))
      out.push_back({file.path, number, pattern.rule, "`" + match.str() + "`: " + pattern.advice});
}

}  // namespace

std::vector<Violation> check_text(const SourceFile& file) {
  std::vector<Violation> violations;
  const std::string code = code_only(file.text);
  for (const Pattern& pattern : patterns())
    if (pattern.in_tests || !is_under(file.path, "tests")) search(file, pattern.in_comments ? file.text : code, pattern, violations);

  if (file.path.ends_with(".h") && code.find("#pragma once") == std::string::npos)
    violations.push_back({file.path, 0, "pragma once", "the header lacks it"});

  const auto lines = std::ranges::count(file.text, '\n');
  if (lines > kMaxLines && !file.path.ends_with("_table.inc"))
    violations.push_back({file.path, 0, "size", std::to_string(lines) + " lines, at most " + std::to_string(kMaxLines)});

  static const std::regex kSnakeCase("([a-z0-9_]+/)*[a-z0-9_]+\\.(h|cpp|inc)");
  if (!std::regex_match(file.path, kSnakeCase)) violations.push_back({file.path, 0, "file name", "snake_case expected"});
  return violations;
}

std::vector<Violation> check_texts(const std::vector<SourceFile>& files, const std::vector<Exemption>& exemptions) {
  std::vector<Violation> result;
  std::vector<bool> used(exemptions.size());
  for (const SourceFile& file : files) {
    for (const Violation& violation : check_text(file)) {
      const auto exemption = std::ranges::find_if(
          exemptions, [&](const Exemption& e) { return e.path == violation.path && e.rule == violation.rule && !e.reason.empty(); });
      if (exemption == exemptions.end())
        result.push_back(violation);
      else
        used[static_cast<std::size_t>(exemption - exemptions.begin())] = true;
    }
  }
  for (std::size_t i = 0; i < exemptions.size(); ++i)
    if (!used[i]) result.push_back({exemptions[i].path, 0, "unused exemption", exemptions[i].rule});
  return result;
}

}  // namespace etalon::test
