#include "validation/report/html_report.h"

#include <array>
#include <system_error>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/atomic_file.h"
#include "raster/cpu_renderer.h"
#include "validation/report/html_case.h"
#include "validation/report/html_text.h"
#include "validation/report/json_report.h"
#include "validation/report/page_assets.h"
#include "validation/texel_explainer.h"

namespace etalon::validation {
namespace {

struct Banner {
  const char* seal;
  std::string headline;
  std::string sentence;
};

std::string agreement(const VerifyResult& result) {
  const ClassTally total = result.total();
  std::string text = fmt::format("{} texels were drawn by the exact rasterizer and by OpenGL. {} are the same bytes", grouped(total.texels),
                                 share(total.identical, total.texels));
  if (total.rounding > 0) text += fmt::format("; {} differ by a legal rounding", grouped(total.rounding));
  if (total.tie > 0) text += fmt::format("; {} fell the other way of a tie, proven by redrawing", grouped(total.tie));
  if (total.unbounded > 0)
    text += fmt::format("; {} lie where the device's own arithmetic gives no useful bound", grouped(total.unbounded));
  text += ".";
  if (result.bounds_measured) text += " The device's bounds are not derived for it: this is agreement, not proof.";
  return text;
}

// A warning: there was a device, or there was not, and what is missing from a whole answer.
Banner incomplete(const VerifyResult& result) {
  if (!result.gl_unavailable.empty()) {
    return {"–", "Nothing was compared.",
            "OpenGL is not available: " + escaped(result.gl_unavailable) + ". The pictures of the exact side are below."};
  }
  const std::size_t skipped = result.skipped_cases();
  if (result.total().texels == 0) {
    return {"–", "Nothing was compared.",
            skipped == 0 ? "No job could be done on this input." : "The device could not draw any scene. The reasons are below."};
  }
  if (result.covered() == 0)
    return {"–", "Nothing was drawn.", "No triangle covers a texel in any scene: only the background was compared."};
  return {"–", "Not every scene was compared.",
          fmt::format("The device could not draw {} of the scenes; the reasons are below. ", skipped) + agreement(result)};
}

Banner banner(const VerifyResult& result) {
  const ClassTally total = result.total();
  switch (verdict(result)) {
    case Verdict::agreed: return {"=", total.unbounded == 0 ? "Every texel is explained." : "No texel is unexplained.", agreement(result)};
    case Verdict::not_compared: return incomplete(result);
    case Verdict::failed:
      return {"≠", fmt::format("{} texels are unexplained.", grouped(total.unexplained)),
              fmt::format("Of {} texels compared; one of the two renderers is wrong there. The diagnosis and the texels are below.",
                          grouped(total.texels))};
  }
  return {};
}

std::string tally_cell(const std::string& css, const std::string& name, std::uint64_t count, std::uint64_t all) {
  return fmt::format("<div><dt class=\"{}\"><i class=\"swatch\"></i>{}</dt><dd>{}<small>{}</small></dd></div>", css, name, grouped(count),
                     all == 0 ? "–" : share(count, all));
}

std::string class_bar(const ClassTally& t) {
  const std::array<std::pair<const char*, std::uint64_t>, kClassCount> parts{
      {{"identical", t.identical}, {"rounding", t.rounding}, {"tie", t.tie}, {"unbounded", t.unbounded}, {"unexplained", t.unexplained}}};
  std::string bar = "<div class=\"bar\" aria-hidden=\"true\">";
  for (const auto& [css, count] : parts) {
    if (count > 0)
      bar +=
          fmt::format("<i class=\"{}\" style=\"flex:{:.6f} 0 auto\"></i>", css, static_cast<double>(count) / static_cast<double>(t.texels));
  }
  return bar + "</div>";
}

// The first picture, beside the verdict: the script copies it from the first scene, so that it is embedded once.
std::string hero(const VerifyResult& result) {
  for (std::size_t j = 0; j < result.jobs.size(); ++j) {
    for (std::size_t i = 0; i < result.jobs[j].cases.size(); ++i) {
      const CaseResult& item = result.jobs[j].cases[i];
      if (item.targets.empty()) continue;
      return fmt::format(
          "<figure class=\"hero\" data-from=\"case-{0}-{1}\" hidden><a class=\"soft\" href=\"#case-{0}-{1}\">{2}</a></figure>", j, i,
          escaped(item.name()));
    }
  }
  return "";
}

// Pictures carry the names of those who must be named.
std::string credits(const VerifyResult& result) {
  std::string html;
  for (const VerifyInput& input : result.inputs) {
    if (!input.attribution.empty() && html.find(escaped(input.attribution)) == std::string::npos)
      html += "<br><span>model by</span> " + escaped(input.attribution);
  }
  return html;
}

std::string verdict_section(const VerifyResult& result) {
  const ClassTally t = result.total();
  const Banner words = banner(result);
  std::string html = fmt::format(
      "<section class=\"verdict {}\" aria-label=\"Verdict\"><div class=\"words\"><div class=\"verdict-head\"><div class=\"seal\" "
      "aria-hidden=\"true\">{}</div><div><strong>{}</strong><p>{}</p></div></div>",
      to_string(verdict(result)), words.seal, escaped(words.headline), words.sentence);
  if (t.texels > 0) {
    html += class_bar(t) + "<dl class=\"tally\">" + tally_cell("identical", "identical", t.identical, t.texels) +
            tally_cell("rounding", "rounding", t.rounding, t.texels) + tally_cell("tie", "tie", t.tie, t.texels) +
            tally_cell("unbounded", "unbounded", t.unbounded, t.texels) +
            tally_cell("unexplained", "unexplained", t.unexplained, t.texels) + "</dl>";
  }
  html += fmt::format("<p class=\"sides\"><span>exact side</span> {}<br><span>device</span> {}{}</p></div>", escaped(result.cpu_name),
                      escaped(result.gl_name.empty() ? "none" : result.gl_name), credits(result));
  html += hero(result) + "</section>";
  if (result.caveats.empty()) return html;
  html += "<div class=\"callout quiet\">";
  for (std::size_t i = 0; i < result.caveats.size(); ++i) html += (i > 0 ? "<br>" : "") + escaped(result.caveats[i]);
  return html + "</div>";
}

std::string number_cell(std::uint64_t count, bool alarm = false) {
  const char* css = count == 0 ? "n zero" : alarm ? "n alarm" : "n";
  return fmt::format("<td class=\"{}\">{}</td>", css, grouped(count));
}

std::string tally_cells(const ClassTally& t) {
  return number_cell(t.texels) + number_cell(t.identical) + number_cell(t.rounding) + number_cell(t.tie) + number_cell(t.unbounded) +
         number_cell(t.unexplained, true);
}

std::string class_table(const VerifyResult& result) {
  std::string html =
      "<div class=\"table\"><table><caption class=\"visually-hidden\">Texels by class</caption><thead><tr><th scope=\"col\">job</th><th "
      "scope=\"col\">scene</th>"
      "<th class=\"n\" scope=\"col\">texels</th>";
  for (const char* name : {"identical", "rounding", "tie", "unbounded", "unexplained"})
    html += fmt::format("<th class=\"n\" scope=\"col\">{}</th>", class_chip(name));
  html += "</tr></thead><tbody>";
  for (std::size_t j = 0; j < result.jobs.size(); ++j) {
    const JobResult& job = result.jobs[j];
    if (!job.skipped.empty())
      html += fmt::format("<tr><td>{}</td><td class=\"skip\" colspan=\"7\">skipped: {}</td></tr>", escaped(job.job), escaped(job.skipped));
    for (std::size_t i = 0; i < job.cases.size(); ++i) {
      const CaseResult& item = job.cases[i];
      html += fmt::format(
          "<tr><td>{}</td><td><a href=\"#case-{}-{}\">{}</a></td>{}</tr>", i == 0 ? escaped(job.job) : "", j, i, escaped(item.name()),
          item.skipped.empty() ? tally_cells(item.tally) : "<td class=\"skip\" colspan=\"6\">skipped: " + escaped(item.skipped) + "</td>");
    }
  }
  return html + fmt::format("</tbody><tfoot><tr class=\"total\"><th scope=\"row\" colspan=\"2\">total</th>{}</tr></tfoot></table></div>",
                            tally_cells(result.total()));
}

const char* lead_of(const std::string& job) {
  if (job == "indexed") return "The texture is read through an indexing map: a first look-up gives the coordinate of a second one.";
  if (job == "adapt")
    return "An indexing map is re-sampled, collapse by collapse, for a coarser mesh, and back. Each texel of each pass is compared; the "
           "pictures "
           "are the maps that come out in the end, red and green being the coordinates they hold.";
  if (job == "bake")
    return "The model as few triangles whose texture map holds its colours, one half-square of texels each: a lookup that misses its own "
           "half-square shows another part of the surface.";
  if (job == "joint")
    return "A procedural terrain and its image as pairs of levels in one budget of bits: each mesh drawn into its texture coordinates, "
           "each "
           "texture looked up through the exact ones. It is the same whatever the models.";
  return "The textured model, in perspective, with depth test.";
}

std::string job_sections(const VerifyResult& result) {
  std::string html;
  for (std::size_t j = 0; j < result.jobs.size(); ++j) {
    const JobResult& job = result.jobs[j];
    if (job.cases.empty()) continue;
    html += fmt::format("<h2 id=\"job-{0}\">{0}</h2><p class=\"lede\">{1}</p>", escaped(job.job), lead_of(job.job));
    for (std::size_t i = 0; i < job.cases.size(); ++i) html += case_article(job.cases[i], fmt::format("case-{}-{}", j, i));
  }
  return html;
}

constexpr const char* kMeanings = R"(<h2>What the classes mean</h2><dl class="meaning">
<dt class="identical"><i class="swatch"></i> identical</dt><dd>The same bytes.</dd>
<dt class="rounding"><i class="swatch"></i> rounding</dt><dd>The same decisions; the device's value is a legal rounding of some number within its error bound of the exact one.</dd>
<dt class="tie"><i class="swatch"></i> tie</dt><dd>The device chose the neighbouring texel or the other of two depths. The exact margin of that decision lies within the bound, and the value is the one that the other choice gives: proven by redrawing it.</dd>
<dt class="unbounded"><i class="swatch"></i> unbounded</dt><dd>The device's own arithmetic gives no useful bound here: slivers on which its float32 setup degenerates. Counted apart, printed even when 0.</dd>
<dt class="unexplained"><i class="swatch"></i> unexplained</dt><dd>Anything else: a defect of one side. A single one fails the check. Coverage has no tolerance at all: any difference in it ends up here.</dd>
</dl>)";

std::string inputs_section(const VerifyResult& result) {
  std::string html =
      "<h2>Inputs</h2><div class=\"table\"><table><thead><tr><th scope=\"col\">role</th><th scope=\"col\">name</th><th "
      "scope=\"col\">sha256</th></tr></thead><tbody>";
  for (const VerifyInput& input : result.inputs) {
    html +=
        fmt::format("<tr><td>{}</td><td>{}{}</td><td class=\"sha\">{}</td></tr>", escaped(input.role), escaped(input.name),
                    input.attribution.empty() ? "" : "<br><span class=\"soft\">" + escaped(input.attribution) + "</span>", input.sha256);
  }
  html += "</tbody></table></div>";
  if (result.notes.empty()) return html;
  html += "<div class=\"callout quiet\">";
  for (std::size_t i = 0; i < result.notes.size(); ++i) html += (i > 0 ? "<br>" : "") + escaped(result.notes[i]);
  return html + "</div>";
}

std::string row(const std::string& name, const std::string& value) { return fmt::format("<dt>{}</dt><dd>{}</dd>", name, escaped(value)); }

std::string state_text(const RasterState& state) {
  return fmt::format("{} sub-texel bits, rounded {}; fill rule {}; half rounded {}", state.subtexel_bits, to_string(state.snap),
                     to_string(state.fill_rule), to_string(state.half_rounding));
}

std::string run_section(const VerifyResult& result, const RunInfo& run) {
  return "<h2>This run</h2><dl class=\"env\">" +
         row("etalon", fmt::format("{}, contract {}", run.version, raster::kRasterContractVersion)) + row("exact side", result.cpu_name) +
         row("device", result.gl_name.empty() ? "none: " + result.gl_unavailable : result.gl_name) + row("bounds", result.bounds_origin) +
         row("raster state", state_text(result.state)) + row("threads", std::to_string(run.threads)) +
         row("time", fmt::format("{:.1f} s", run.seconds)) +
         row("memory", fmt::format("{:.0f} MiB at most", static_cast<double>(run.peak_bytes) / 1048576)) + "</dl>";
}

std::string attributions(const VerifyResult& result) {
  std::string html;
  for (const VerifyInput& input : result.inputs) {
    if (!input.attribution.empty() && html.find(escaped(input.attribution)) == std::string::npos)
      html += "<p>" + escaped(input.name) + ": " + escaped(input.attribution) + ".</p>";
  }
  return html;
}

// Inside a script element no "<" of a name may look like a tag or a comment; JSON can write it otherwise.
std::string json_for_script(const std::string& text) {
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

}  // namespace

std::string verify_page(const VerifyResult& result, const RunInfo& run) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\">";
  html += "<title>etalon: " + escaped(banner(result).headline) + "</title><style>" + kPageCss + "</style></head><body>";
  html +=
      "<header class=\"masthead\"><div class=\"graduation\" style=\"max-width:none;padding:0\" "
      "aria-hidden=\"true\"></div><div><h1>étalon</h1><p class=\"lede\">Two renderers, one scene, every texel accounted for.</p>"
      "<button id=\"theme\" type=\"button\" hidden>light / dark</button></div></header><main>";
  html +=
      verdict_section(result) + class_table(result) + job_sections(result) + kMeanings + inputs_section(result) + run_section(result, run);
  html +=
      "</main><footer><div class=\"graduation\" style=\"max-width:none;padding:0\" aria-hidden=\"true\"></div><div>" +
      attributions(result) +
      "<p>The same figures for programs: verify.json and classes.csv beside this page. Row 0 of an image is its lowest.</p></div></footer>";
  html += "<script type=\"application/json\" id=\"etalon-verify\">" + json_for_script(to_text(verify_document(result, run))) +
          "</script><script>" + kPageJs + "</script></body></html>\n";
  return html;
}

std::filesystem::path write_verify_report(const std::filesystem::path& folder, const VerifyResult& result, const RunInfo& run) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder)) {
    throw WriteError(fmt::format("{}: {}", folder.string(), error ? error.message() : "is not a folder"));
  }
  const std::filesystem::path page = folder / "index.html";
  io::write_files({{folder / "verify.json", to_text(verify_document(result, run))},
                   {folder / "classes.csv", verify_csv(result)},
                   {page, verify_page(result, run)}});
  return page;
}

std::string file_url(const std::filesystem::path& path) {
  std::string url = "file://";
  for (const char c : std::filesystem::absolute(path).lexically_normal().string()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z') || (byte >= 'a' && byte <= 'z') ||
                       std::string_view("-._~/!$&'()*+,;=:@").find(c) != std::string_view::npos;
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return url;
}

}  // namespace etalon::validation
