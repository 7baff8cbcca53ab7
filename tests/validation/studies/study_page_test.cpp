#include "validation/report/study_page.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/base/error.h"
#include "tests/io/scratch.h"
#include "validation/report/study_markdown.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

StudyReport sample() {
  StudyReport report;
  report.name = "sample";
  report.title = "A <study>";
  report.claims = {
      {.where = "table 1", .claim = "small & fast", .measured = "0.5", .why = "", .verdict = ClaimVerdict::holds, .timed = false},
      {.where = "table 2", .claim = "quick", .measured = "2 s", .why = "slow", .verdict = ClaimVerdict::fails, .timed = true}};
  report.tables = {
      {.name = "sizes",
       .title = "Sizes",
       .note = "",
       .columns = {"model", "count", "none"},
       .rows = {{{"a, \"b\"", {}}, count_cell(1234), number_cell({}, 2)}, {{"a, \"b\"", {}}, number_cell(0.125, 2), number_cell({}, 2)}}},
      {.name = "times", .title = "Times", .note = "", .columns = {"s"}, .rows = {{number_cell(1.5, 1)}}, .timed = true, .folded = true}};
  Image red(1, 1, kRgb8);
  red.channels<std::uint8_t>(0, 0)[0] = 255;
  report.figures = {{.id = "one", .title = "One", .caption = "", .svg = "<svg></svg>", .pictures = {{"p.png", "a picture", red}}},
                    {.id = "two", .title = "Two", .caption = "", .svg = "", .pictures = {{"p.png", "again", red}}}};
  return report;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("a table as CSV: quoted where needed, numbers in full, dashes where there is none") {
  CHECK(study_csv(sample().tables[0]) == "model,count,none\r\n\"a, \"\"b\"\"\",1234,–\r\n\"a, \"\"b\"\"\",0.125,–\r\n");
}

TEST_CASE("the document keeps times apart") {
  const auto document = study_document(sample(), {});
  CHECK(document["schema"] == "etalon/study/1");
  CHECK(document["tables"].size() == 1);
  CHECK(document["tables"][0]["rows"][0][1] == 1234);
  CHECK(document["claims"].size() == 1);
  CHECK(document["run"]["tables"][0]["name"] == "times");
  CHECK(document["run"]["claims"][0]["verdict"] == "fails");
  CHECK(document["pictures"].size() == 1);
}

TEST_CASE("the page escapes, stands alone, and the folder holds every file") {
  const std::string page = study_page(sample(), {});
  CHECK(page.find("A &lt;study&gt;") != std::string::npos);
  CHECK(page.find("small &amp; fast") != std::string::npos);
  CHECK(page.find("claim fails") != std::string::npos);
  CHECK(page.find("http://") == std::string::npos);
  CHECK(page.find("https://") == std::string::npos);
  const test::ScratchFolder folder;
  const std::filesystem::path written = write_study(folder.path() / "deep" / "study", sample(), {}, "etalon study sample");
  CHECK(written.filename() == "index.html");
  CHECK(study_files(sample()) ==
        std::vector<std::string>{"p.png", "one.svg", "sizes.csv", "times.csv", "study.md", "study.json", "index.html"});
  for (const std::string& file : study_files(sample())) {
    CAPTURE(file);
    CHECK(!text_of(written.parent_path() / file).empty());
  }
  CHECK(text_of(written) == page);
}

TEST_CASE("the page of documentation: what was typed, when and where, claims, tables that are not folded") {
  StudyReport report = sample();
  report.tables[0].columns[0] = "a|b";
  const std::string text = study_markdown(report, {.version = "9"}, "etalon study sample", "2001-02-03, a processor, 2 threads");
  CHECK(text.find("*Written by `etalon study sample`, etalon 9: 2001-02-03, a processor, 2 threads.*") != std::string::npos);
  CHECK(text.find("- **fails**: quick (table 2) 2 s *slow*") != std::string::npos);
  CHECK(text.find("| a\\|b | count | none |\n|---|---:|---:|\n| a, \"b\" | 1,234 | – |") != std::string::npos);
  CHECK(text.find("Times") == std::string::npos);
  RunInfo run;
  run.threads = 1;
  CHECK(measured_on(run).find(", 1 thread") != std::string::npos);
  CHECK(measured_on(run).size() > std::string("2026-11-22, x, 1 thread").size());
}

TEST_CASE("a figure's drawing is a file of its own, and the page of documentation shows it with the pictures") {
  StudyReport report = sample();
  report.figures[0].svg = "<svg viewBox=\"0 0 1 1\"><text class=\"faint\">x</text></svg>";
  const std::string drawing = report.figures[0].id + ".svg";
  const std::vector<std::string> files = study_files(report);
  CHECK(std::count(files.begin(), files.end(), drawing) == 1);
  const test::ScratchFolder folder;
  (void)write_study(folder.path(), report, {}, "");
  const std::string svg = text_of(folder.path() / drawing);
  CHECK(svg.find("<svg viewBox=\"0 0 1 1\"><style>") == 0);
  CHECK(svg.find("class=\"faint\">x</text></svg>\n") != std::string::npos);
  const std::string text = study_markdown(report, {}, "", "");
  CHECK(text.find("](" + drawing + ")") != std::string::npos);
  CHECK(text.find("](p.png)") != std::string::npos);
}

TEST_CASE("a study that cannot be written is a WriteError") {
  const test::ScratchFolder folder;
  { std::ofstream(folder.path() / "file") << "x"; }
  CHECK_THROWS_AS((void)write_study(folder.path() / "file", sample(), {}, ""), WriteError);
}
