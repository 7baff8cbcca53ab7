#include "validation/report/study_index.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace etalon::validation {
namespace {

constexpr std::size_t kPictures = 6;

enum Table : std::size_t { kVerdicts, kClaims, kTimedClaims, kTableCount };

StudyFigure figure_of(const StudyReport& report) {
  StudyFigure figure;
  figure.id = report.name;
  figure.title = report.title;
  figure.caption = report.paper;
  figure.links.push_back({report.name + "/index.html", "the study: all figures, how it was measured, its inputs"});
  for (const StudyTable& table : report.tables) figure.links.push_back({fmt::format("{}/{}.csv", report.name, table.name), table.title});
  for (const StudyFigure& source : report.figures)
    for (const StudyPicture& picture : source.pictures) {
      const std::string file = report.name + "-" + picture.file;
      const bool is_there = std::ranges::any_of(figure.pictures, [&](const StudyPicture& other) { return other.file == file; });
      if (figure.pictures.size() < kPictures && !is_there) figure.pictures.push_back({file, picture.label, picture.image});
    }
  return figure;
}

}  // namespace

StudyReport make_study_index() {
  StudyReport index;
  index.name = "all";
  index.title = "Four papers measured again";
  index.paper = "Soucy, Godin & Rioux 1996; Chen & Chuang 2006; Kim, Choi & Lee 2008; Horbelt, Balmelli & Vetterli.";
  index.lede = "What each paper claims, what we measured, and whether it holds. Each study has its own page with every table and figure.";
  index.tables.resize(kTableCount);
  index.tables[kVerdicts] = {.name = "verdicts",
                             .title = "Verdicts",
                             .note = "Claims of each study; those that rest on times are counted in the last column only.",
                             .columns = {"study", "claims", "hold", "in part", "do not hold", "rest on times"}};
  index.tables[kClaims] = {.name = "all-claims",
                           .title = "All claims as a table",
                           .note = "The claims above, those that rest on times apart.",
                           .columns = {"study", "where", "claim", "measured", "verdict", "why"},
                           .folded = true};
  index.tables[kTimedClaims] = index.tables[kClaims];
  index.tables[kTimedClaims].name = "timed-claims";
  index.tables[kTimedClaims].title = "Claims that rest on times";
  index.tables[kTimedClaims].note = "Of this run on this machine.";
  index.tables[kTimedClaims].timed = true;
  return index;
}

void add_to_index(StudyReport& index, const StudyReport& report) {
  std::array<std::uint64_t, 3> counts{};
  std::uint64_t timed_count = 0;
  for (const StudyClaim& claim : report.claims) {
    (claim.timed ? timed_count : counts[static_cast<std::size_t>(claim.verdict)]) += 1;
    index.claims.push_back(claim);
    index.claims.back().where = report.name + ": " + claim.where;
    index.tables[claim.timed ? kTimedClaims : kClaims].rows.push_back(
        {{report.name, {}}, {claim.where, {}}, {claim.claim, {}}, {claim.measured, {}}, {to_string(claim.verdict), {}}, {claim.why, {}}});
  }
  index.tables[kVerdicts].rows.push_back({{report.name, {}},
                                          count_cell(counts[0] + counts[1] + counts[2]),
                                          count_cell(counts[0]),
                                          count_cell(counts[1]),
                                          count_cell(counts[2]),
                                          count_cell(timed_count)});
  for (const VerifyInput& input : report.inputs)
    if (std::ranges::none_of(index.inputs,
                             [&](const VerifyInput& other) { return other.name == input.name && other.sha256 == input.sha256; }))
      index.inputs.push_back(input);
  index.notes.push_back(fmt::format("{}: how it was measured stands on its own page, {}/index.html.", report.name, report.name));
  index.figures.push_back(figure_of(report));
}

}  // namespace etalon::validation
