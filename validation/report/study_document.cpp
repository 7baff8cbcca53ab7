#include <algorithm>
#include <span>
#include <system_error>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/sha256.h"
#include "core/io/atomic_file.h"
#include "core/io/image_file.h"
#include "validation/report/json_report.h"
#include "validation/report/study_markdown.h"
#include "validation/report/study_page.h"

namespace etalon::validation {

namespace {

using Json = nlohmann::ordered_json;

Json cell_json(const StudyCell& cell) { return cell.value ? Json(*cell.value) : Json(cell.text); }

Json table_json(const StudyTable& table) {
  Json rows = Json::array();
  for (const auto& row : table.rows) {
    Json cells = Json::array();
    for (const StudyCell& cell : row) cells.push_back(cell_json(cell));
    rows.push_back(std::move(cells));
  }
  return {{"name", table.name}, {"title", table.title}, {"note", table.note}, {"columns", table.columns}, {"rows", std::move(rows)}};
}

Json claim_json(const StudyClaim& claim) {
  return {{"paper", claim.where},
          {"claim", claim.claim},
          {"measured", claim.measured},
          {"verdict", to_string(claim.verdict)},
          {"why", claim.why}};
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + "\"";
}

/// Each picture once.
std::vector<const StudyPicture*> pictures_of(const StudyReport& report) {
  std::vector<const StudyPicture*> pictures;
  for (const StudyFigure& figure : report.figures)
    for (const StudyPicture& picture : figure.pictures)
      if (std::none_of(pictures.begin(), pictures.end(), [&](const StudyPicture* other) { return other->file == picture.file; }))
        pictures.push_back(&picture);
  return pictures;
}

/// A drawing that stands alone: what study.css says of its classes, in dark on white.
std::string standalone(const std::string& svg) {
  constexpr const char* kStyle =
      "<style>svg{background:#fff;color:#1a1f2b}text{font:13px sans-serif;fill:#1a1f2b}.faint{fill:#667}.axis{stroke:#667;stroke-width:1}"
      ".grid{stroke:#ddd;stroke-width:1}</style>";
  const std::size_t head = svg.find('>') + 1;
  return svg.substr(0, head) + kStyle + svg.substr(head) + "\n";
}

/// File name and bytes, index.html last.
std::vector<std::pair<std::string, std::string>> contents(const StudyReport& report, const RunInfo& run, const std::string& command) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const StudyPicture* picture : pictures_of(report)) files.emplace_back(picture->file, io::encode_png(picture->image, picture->file));
  for (const StudyFigure& figure : report.figures) {
    if (!figure.svg.empty()) files.emplace_back(study_drawing_file(figure), standalone(figure.svg));
    for (const StudyFile& file : figure.files) files.emplace_back(file.file, file.bytes);
  }
  for (const StudyTable& table : report.tables) files.emplace_back(table.name + ".csv", study_csv(table));
  files.emplace_back("study.md", study_markdown(report, run, command, measured_on(run)));
  files.emplace_back("study.json", to_text(study_document(report, run)));
  files.emplace_back("index.html", study_page(report, run));
  return files;
}

}  // namespace

const char* to_string(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::holds: return "holds";
    case ClaimVerdict::partly: return "partly";
    case ClaimVerdict::fails: return "fails";
  }
  return "";
}

StudyCell number_cell(std::optional<double> value, int digits) {
  if (!value) return {"–", {}};
  return {fmt::format("{:.{}f}", *value, digits), value};
}

StudyCell count_cell(std::uint64_t value) { return {grouped(value), static_cast<double>(value)}; }

Json study_document(const StudyReport& report, const RunInfo& run) {
  Json document = document_head("study", report.inputs);
  document["study"] = report.name;
  document["paper"] = report.paper;
  Json tables = Json::array(), timed_tables = Json::array(), claims = Json::array(), timed_claims = Json::array(), pictures = Json::array();
  for (const StudyTable& table : report.tables) (table.timed ? timed_tables : tables).push_back(table_json(table));
  for (const StudyClaim& claim : report.claims) (claim.timed ? timed_claims : claims).push_back(claim_json(claim));
  for (const StudyPicture* picture : pictures_of(report))
    pictures.push_back({{"file", picture->file}, {"label", picture->label}, {"sha256", picture->image.sha256()}});
  document["tables"] = std::move(tables);
  document["claims"] = std::move(claims);
  document["pictures"] = std::move(pictures);
  Json files = Json::array();
  for (const StudyFigure& figure : report.figures)
    for (const StudyFile& file : figure.files)
      files.push_back({{"file", file.file}, {"label", file.label}, {"sha256", sha256_hex(std::as_bytes(std::span(file.bytes)))}});
  if (!files.empty()) document["files"] = std::move(files);
  document["notes"] = report.notes;
  Json about_run = to_json(run);
  about_run["tables"] = std::move(timed_tables);
  about_run["claims"] = std::move(timed_claims);
  document["run"] = std::move(about_run);
  return document;
}

std::string study_csv(const StudyTable& table) {
  std::string text;
  const auto line = [&](const auto& cells, const auto& text_of) {
    for (std::size_t i = 0; i < cells.size(); ++i) text += (i > 0 ? "," : "") + quoted(text_of(cells[i]));
    text += "\r\n";
  };
  line(table.columns, [](const std::string& name) { return name; });
  for (const auto& row : table.rows)
    line(row, [](const StudyCell& cell) { return cell.value ? fmt::format("{:.9g}", *cell.value) : cell.text; });
  return text;
}

std::vector<std::string> study_files(const StudyReport& report) {
  std::vector<std::string> names;
  for (const StudyPicture* picture : pictures_of(report)) names.push_back(picture->file);
  for (const StudyFigure& figure : report.figures) {
    if (!figure.svg.empty()) names.push_back(study_drawing_file(figure));
    for (const StudyFile& file : figure.files) names.push_back(file.file);
  }
  for (const StudyTable& table : report.tables) names.push_back(table.name + ".csv");
  names.insert(names.end(), {"study.md", "study.json", "index.html"});
  return names;
}

std::filesystem::path write_study(const std::filesystem::path& folder, const StudyReport& report, const RunInfo& run,
                                  const std::string& command) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw WriteError(fmt::format("{}: {}", folder.string(), error ? error.message() : "is not a folder"));
  std::vector<std::pair<std::filesystem::path, std::string>> files;
  for (auto& [name, bytes] : contents(report, run, command)) files.emplace_back(folder / name, std::move(bytes));
  io::write_files(files);
  return files.back().first;
}

}  // namespace etalon::validation
