#include "validation/report/study_markdown.h"

#include <chrono>
#include <ctime>
#include <fstream>

#include <fmt/format.h>

namespace etalon::validation {

namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

/// A cell must not end its column.
std::string cell(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '|') safe += '\\';
    safe += c == '\n' ? ' ' : c;
  }
  return safe;
}

std::string table_text(const StudyTable& table) {
  std::string text = fmt::format("\n## {}\n\n{}\n\n|", table.title, table.note);
  for (const std::string& column : table.columns) text += " " + cell(column) + " |";
  text += "\n|";
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    bool numeric = !table.rows.empty();
    for (const auto& row : table.rows) numeric = numeric && (row[i].value || row[i].text == "–");
    text += numeric ? "---:|" : "---|";
  }
  text += "\n";
  for (const auto& row : table.rows) {
    text += "|";
    for (const StudyCell& value : row) text += " " + cell(value.text) + " |";
    text += "\n";
  }
  return text;
}

}  // namespace

std::string study_drawing_file(const StudyFigure& figure) { return figure.id + ".svg"; }

std::string measured_on(const RunInfo& run) {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  return fmt::format("{:04}-{:02}-{:02}, {}, {} thread{}", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday, processor(), run.threads,
                     run.threads == 1 ? "" : "s");
}

std::string study_markdown(const StudyReport& report, const RunInfo& run, const std::string& command, const std::string& measured) {
  std::string text = fmt::format("# {}\n\n{}\n\n{}\n\n*Written by `{}`, etalon {}: {}{}.*\n\n## Claims\n\n", report.title, report.paper,
                                 report.lede, command, run.version, measured, run.device.empty() ? "" : "; OpenGL: " + run.device);
  for (const StudyClaim& claim : report.claims) {
    text += fmt::format("- **{}**: {} ({}) {}", to_string(claim.verdict), claim.claim, claim.where, claim.measured);
    text += claim.why.empty() ? "\n" : " *" + claim.why.substr(0, claim.why.find_last_not_of(' ') + 1) + "*\n";
  }
  for (const StudyTable& table : report.tables)
    if (!table.folded) text += table_text(table);
  text += "\n## How it was measured\n\n";
  for (const std::string& note : report.notes) text += "- " + note + "\n";
  text += "\n## Inputs\n\n";
  for (const VerifyInput& input : report.inputs)
    text += fmt::format("- {}, sha256 `{}`{}\n", input.name, input.sha256, input.attribution.empty() ? "" : ": " + input.attribution);
  text += "\n## Figures\n";
  for (const StudyFigure& figure : report.figures) {
    text += fmt::format("\n### {}\n\n{}\n", figure.title, figure.caption);
    for (const StudyFile& file : figure.files) text += fmt::format("\n[{0}]({0}): {1}\n", file.file, file.label);
    for (const StudyLink& link : figure.links) text += fmt::format("\n[{0}]({0}): {1}\n", link.href, link.label);
    if (!figure.svg.empty()) text += fmt::format("\n![{}]({})\n", figure.title, study_drawing_file(figure));
    for (const StudyPicture& picture : figure.pictures) text += fmt::format("\n![{0}]({1})\n{0}\n", picture.label, picture.file);
  }
  return text;
}

}  // namespace etalon::validation
