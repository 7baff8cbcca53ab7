#include "validation/report/study_page.h"

#include <fmt/format.h>

#include "raster/cpu_renderer.h"
#include "validation/report/html_text.h"
#include "validation/report/page_assets.h"

namespace etalon::validation {

namespace {

std::string claim_item(const StudyClaim& claim) {
  std::string html = fmt::format(
      "<article class=\"claim {0}\"><span class=\"verdict-word\">{0}</span><p>{1} <span "
      "class=\"where\">({2})</span></p><p><strong>{3}</strong></p>",
      to_string(claim.verdict), escaped(claim.claim), escaped(claim.where), escaped(claim.measured));
  if (!claim.why.empty()) html += fmt::format("<p class=\"why\">{}</p>", escaped(claim.why));
  return html + "</article>";
}

std::string table_html(const StudyTable& table) {
  std::string html = fmt::format("<h3 id=\"{}\">{}</h3><p class=\"soft\">{}</p>", table.name, escaped(table.title), escaped(table.note));
  if (table.folded) html += fmt::format("<details class=\"folded\"><summary>{} rows</summary>", table.rows.size());
  html += fmt::format("<div class=\"table\"><table{}><thead><tr>", table.columns.size() > 8 ? " class=\"wide\"" : "");
  // A column of numbers, or of none at all, is set flush right with its head.
  std::vector<bool> numeric(table.columns.size(), true);
  for (const auto& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      if (!row[i].value && row[i].text != "–") numeric[i] = false;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    html += fmt::format("<th scope=\"col\"{}>{}</th>", numeric[i] ? " class=\"n\"" : "", escaped(table.columns[i]));
  html += "</tr></thead><tbody>";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto& row = table.rows[r];
    const bool same = r > 0 && row.front().text == table.rows[r - 1].front().text;
    html += same ? "<tr>" : "<tr class=\"first\">";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const char* css = i == 0 && same ? " class=\"again\"" : numeric[i] ? " class=\"n\"" : "";
      html += fmt::format("<td{}>{}</td>", css, escaped(row[i].text));
    }
    html += "</tr>";
  }
  return html + "</tbody></table></div>" + (table.folded ? "</details>" : "");
}

std::string figure_html(const StudyFigure& figure) {
  std::string html = fmt::format("<article class=\"card\" id=\"{}\"><h3>{}</h3><p class=\"soft\">{}</p>", figure.id, escaped(figure.title),
                                 escaped(figure.caption));
  for (const StudyFile& file : figure.files)
    html += fmt::format("<p class=\"soft\"><a href=\"{0}\">{0}</a>: {1}</p>", escaped(file.file), escaped(file.label));
  for (const StudyLink& link : figure.links)
    html += fmt::format("<p class=\"soft\"><a href=\"{0}\">{0}</a>: {1}</p>", escaped(link.href), escaped(link.label));
  if (!figure.svg.empty()) html += "<div class=\"drawing\">" + figure.svg + "</div>";
  if (!figure.pictures.empty()) {
    html += fmt::format("<div class=\"row{}\" style=\"--columns:{}\">", figure.is_film ? " film" : "", figure.columns);
    for (const StudyPicture& picture : figure.pictures)
      html += fmt::format(
          "<figure><img src=\"{}\" alt=\"{}\" width=\"{}\" height=\"{}\" loading=\"lazy\"><figcaption>{}</figcaption></figure>",
          png_data_uri(picture.image), escaped(picture.label), picture.image.width(), picture.image.height(), escaped(picture.label));
    if (figure.is_film)
      html += fmt::format("<input type=\"range\" min=\"0\" max=\"{}\" value=\"0\" hidden aria-label=\"Picture of {}\">",
                          figure.pictures.size() - 1, escaped(figure.title));
    html += "</div>";
  }
  return html + "</article>";
}

std::string inputs_html(const StudyReport& report) {
  std::string html =
      "<h2>Inputs</h2><div class=\"table\"><table><thead><tr><th scope=\"col\">name</th><th scope=\"col\">sha256</th></tr></thead><tbody>";
  for (const VerifyInput& input : report.inputs)
    html +=
        fmt::format("<tr><td>{}{}</td><td class=\"sha\">{}</td></tr>", escaped(input.name),
                    input.attribution.empty() ? "" : "<br><span class=\"soft\">" + escaped(input.attribution) + "</span>", input.sha256);
  return html + "</tbody></table></div>";
}

std::string row(const std::string& name, const std::string& value) { return fmt::format("<dt>{}</dt><dd>{}</dd>", name, escaped(value)); }

}  // namespace

std::string study_page(const StudyReport& report, const RunInfo& run) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\">";
  html += "<title>etalon: " + escaped(report.title) + "</title><style>" + kPageCss + kStudyCss + "</style></head><body>";
  html +=
      "<header class=\"masthead\"><div class=\"graduation\" style=\"max-width:none;padding:0\" "
      "aria-hidden=\"true\"></div><div><h1>étalon</h1><p "
      "class=\"lede\">" +
      escaped(report.title) + "</p><button id=\"theme\" type=\"button\" hidden>light / dark</button></div></header><main>";
  html += "<p>" + escaped(report.lede) + "</p><p class=\"soft\">" + escaped(report.paper) + "</p><nav><a href=\"#claims\">Claims</a>";
  for (const StudyTable& table : report.tables) html += fmt::format("<a href=\"#{}\">{}</a>", table.name, escaped(table.title));
  for (const StudyFigure& figure : report.figures) html += fmt::format("<a href=\"#{}\">{}</a>", figure.id, escaped(figure.title));
  html += "</nav><h2 id=\"claims\">What the paper claims, and what was measured</h2><div class=\"claims\">";
  for (const StudyClaim& claim : report.claims) html += claim_item(claim);
  html += "</div><h2>Tables</h2>";
  for (const StudyTable& table : report.tables) html += table_html(table);
  html += "<h2>Figures</h2>";
  for (const StudyFigure& figure : report.figures) html += figure_html(figure);
  html += "<h2>How it was measured</h2><ul>";
  for (const std::string& note : report.notes) html += "<li>" + escaped(note) + "</li>";
  html += "</ul>" + inputs_html(report) + "<h2>This run</h2><dl class=\"env\">" +
          row("etalon", fmt::format("{}, contract {}", run.version, raster::kRasterContractVersion)) +
          row("OpenGL", run.device.empty() ? "not used" : run.device) + row("threads", std::to_string(run.threads)) +
          row("time", fmt::format("{:.1f} s", run.seconds)) +
          row("memory", fmt::format("{:.0f} MiB at most", static_cast<double>(run.peak_bytes) / 1048576)) + "</dl>";
  html +=
      "</main><footer><div class=\"graduation\" style=\"max-width:none;padding:0\" aria-hidden=\"true\"></div><div><p>The same for "
      "programs: "
      "study.json, and a CSV file for each table, beside this page.</p></div></footer><script>";
  return html + kPageJs + "</script></body></html>\n";
}

}  // namespace etalon::validation
