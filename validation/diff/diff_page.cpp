#include "validation/diff/diff_page.h"

#include <fmt/format.h>

#include "validation/diff/diff_document.h"
#include "validation/report/html_case.h"
#include "validation/report/html_text.h"
#include "validation/report/json_report.h"
#include "validation/report/page_assets.h"

namespace etalon::validation {
namespace {

struct Banner {
  const char *css, *seal;
  std::string headline, reason;
};

// What one pair comes down to, in a sentence.
std::string reason(const PairResult& pair) {
  if (pair.status != PairStatus::compared) return pair.problem + ".";
  if (pair.pixels.differing == 0) return "Every value is the same.";
  if (pair.device.empty())
    return fmt::format("{} of {} texels differ, {} of them by more than the threshold.", grouped(pair.pixels.differing),
                       grouped(pair.pixels.pixels), grouped(pair.pixels.fail.over));
  std::string text =
      pair.page.tally.unexplained > 0
          ? fmt::format("{} of {} texels are unexplained", grouped(pair.page.tally.unexplained), grouped(pair.pixels.pixels))
          : fmt::format("{} of {} texels differ, each as {} may", grouped(pair.pixels.differing), grouped(pair.pixels.pixels), pair.device);
  if (!pair.page.causes.empty())
    text += fmt::format("; {:.1f} % of them are what this gives: {}", 100 * pair.page.causes.front().share, pair.page.causes.front().name);
  else if (!pair.patterns.empty())
    text += "; " + pair.patterns.front();
  if (pair.unproven_ties > 0) text += fmt::format("; {} perhaps a tie, not proven", grouped(pair.unproven_ties));
  return text + ".";
}

Banner banner(const std::vector<PairResult>& pairs) {
  std::size_t wrong = 0;
  for (const PairResult& pair : pairs) wrong += pair.verdict >= PairVerdict::failure ? 1 : 0;
  const bool single = pairs.size() == 1;
  const std::string why = single ? reason(pairs.front()) : "";
  switch (worst_verdict(pairs)) {
    case PairVerdict::pass: return {"agreed", "=", single ? "The candidate passes." : "All candidates pass.", why};
    case PairVerdict::warning: return {"not_compared", "–", "No failure, with warnings.", why};
    default: break;
  }
  const std::string several = fmt::format("{} of {} candidates {}.", wrong, pairs.size(), wrong == 1 ? "fails" : "fail");
  return {"failed", "≠", single ? "The candidate fails." : several, why};
}

std::string table(const std::vector<PairResult>& pairs) {
  std::string html =
      "<div class=\"table\"><table><caption class=\"visually-hidden\">Pairs</caption><thead><tr><th scope=\"col\">pair</th><th "
      "scope=\"col\">verdict</th><th class=\"n\" scope=\"col\">texels</th><th class=\"n\" scope=\"col\">differ</th><th class=\"n\" "
      "scope=\"col\">max error</th><th class=\"n\" scope=\"col\">tie?</th><th class=\"n\" "
      "scope=\"col\">unexplained</th></tr></thead><tbody>";
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PairResult& pair = pairs[i];
    const bool classes = !pair.device.empty();
    html += fmt::format(
        "<tr><td><a href=\"#pair-{}\">{}</a></td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{:.4g}</td><td "
        "class=\"n\">{}</td><td class=\"n{}\">{}</td></tr>",
        i, escaped(pair.name), to_string(pair.verdict), grouped(pair.pixels.pixels), grouped(pair.pixels.differing), pair.pixels.max_error,
        classes ? grouped(pair.unproven_ties) : "–", pair.page.tally.unexplained > 0 ? " alarm" : "",
        classes ? grouped(pair.page.tally.unexplained) : "–");
  }
  return html + "</tbody></table></div>";
}

std::string pair_section(const PairResult& pair, const PixelThresholds& thresholds, std::size_t i) {
  std::string lines;
  for (const std::string& line : pair_lines(pair, thresholds)) lines += (lines.empty() ? "" : "<br>") + escaped(line);
  const std::string id = fmt::format("pair-{}", i);
  // Without a device there are no classes to show; a folder may hold thousands of pairs that are the same.
  if (pair.page.targets.empty() || pair.pixels.differing == 0)
    return fmt::format(
        "<article class=\"card\" id=\"{}\"><div class=\"card-head\"><h3>{}</h3></div><div class=\"callout quiet\">{}</div></article>", id,
        escaped(pair.name), lines);
  return case_article(pair.page, id) + "<div class=\"callout quiet\">" + lines + "</div>";
}

}  // namespace

std::string diff_page(const std::vector<PairResult>& pairs, const PixelThresholds& thresholds, const RunInfo& run) {
  const Banner words = banner(pairs);
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\"><title>etalon diff: " +
      escaped(words.headline) + "</title><style>" + kPageCss +
      "</style></head><body><header class=\"masthead\"><div class=\"graduation\" style=\"max-width:none;padding:0\" "
      "aria-hidden=\"true\"></div><div><h1>étalon diff</h1><p class=\"lede\">Golden and candidate, texel by texel.</p>"
      "<button id=\"theme\" type=\"button\" hidden>light / dark</button></div></header><main>";
  html += fmt::format(
      "<section class=\"verdict {}\" aria-label=\"Verdict\"><div class=\"words\"><div class=\"verdict-head\"><div class=\"seal\" "
      "aria-hidden=\"true\">{}</div><div><strong>{}</strong>{}</div></div></div></section>",
      words.css, words.seal, escaped(words.headline), words.reason.empty() ? "" : "<p>" + escaped(words.reason) + "</p>");
  html += table(pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i) html += pair_section(pairs[i], thresholds, i);
  html += fmt::format(
      "<h2>This run</h2><dl class=\"env\"><dt>etalon</dt><dd>{}</dd><dt>threads</dt><dd>{}</dd><dt>time</dt><dd>{:.1f} "
      "s</dd></dl></main><footer><div><p>Row 0 of an image is its lowest.</p></div></footer><script>{}</script></body></html>\n",
      escaped(run.version), run.threads, run.seconds, kPageJs);
  return html;
}

}  // namespace etalon::validation
