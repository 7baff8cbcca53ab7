#include "validation/diff/diff_document.h"

#include <fmt/format.h>

#include <cmath>

#include "validation/report/html_text.h"
#include "validation/report/json_report.h"

namespace etalon::validation {
namespace {

using Json = nlohmann::ordered_json;

Json optional_number(const std::optional<double>& value) { return value && std::isfinite(*value) ? Json(*value) : Json(nullptr); }

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json("inf"); }

std::string channel_name(const PixelComparison& pixels) {
  static const char* kNames[] = {"R", "G", "B", "A"};
  return pixels.max_channel < 0 ? "" : kNames[pixels.max_channel & 3];
}

Json to_json(const PixelComparison& p) {
  return {{"differing", p.differing},
          {"mean_error", p.mean_error},
          {"rms_error", p.rms_error},
          {"psnr_db", optional_number(p.psnr_db)},
          {"identical", p.differing == 0},
          {"max_error", finite(p.max_error)},
          {"max_at", p.max_x < 0 ? Json(nullptr) : Json({p.max_x, p.max_y})},
          {"max_channel", p.max_channel < 0 ? Json(nullptr) : Json(channel_name(p))},
          {"max_relative", finite(p.max_relative)},
          {"over_fail", p.fail.over},
          {"over_warn", p.warn.over},
          {"would_pass",
           {{"fail", optional_number(p.passing.absolute)},
            {"failrelative", optional_number(p.passing.relative)},
            {"failpercent", optional_number(p.passing.percent)},
            {"hardfail", optional_number(p.passing.hard)},
            {"allowfailures", p.passing.allow_failures}}}};
}

Json tally_json(const ClassTally& tally, std::uint64_t unproven_ties) {
  return {{"texels", tally.texels}, {"identical", tally.identical}, {"rounding", tally.rounding},      {"tie", tally.tie},
          {"tie?", unproven_ties},  {"unbounded", tally.unbounded}, {"unexplained", tally.unexplained}};
}

Json to_json(const PairResult& pair) {
  Json json = {{"job", pair.name}, {"status", to_string(pair.status)}, {"verdict", to_string(pair.verdict)}};
  if (!pair.problem.empty()) json["problem"] = pair.problem;
  if (pair.status != PairStatus::compared) return json;
  json["width"] = pair.page.width;
  json["height"] = pair.page.height;
  json["golden_sha256"] = pair.golden_sha256;
  json["candidate_sha256"] = pair.candidate_sha256;
  json["pixels"] = to_json(pair.pixels);
  if (!pair.device.empty()) {
    json.update(tally_json(pair.page.tally, pair.unproven_ties));
    json["device"] = {{"name", pair.device},
                      {"bounds", pair.bounds},
                      {"origin", pair.bound_origin},
                      {"proven", pair.bounds_proven},
                      {"by_draws", !pair.draws_path.empty()}};
    json["diagnosis"] = pair.page.diagnosis;
    json["causes"] = Json::array();
    for (const NamedCause& cause : pair.page.causes) json["causes"].push_back({{"name", cause.name}, {"explained_share", cause.share}});
    json["patterns"] = pair.patterns;
    json["worst"] = Json::array();
    for (const WorstTexel& t : pair.page.worst)
      json["worst"].push_back({{"x", t.x},
                               {"y", t.y},
                               {"class", t.texel_class},
                               {"golden", t.cpu_value},
                               {"candidate", t.gl_value},
                               {"explanation", t.explanation}});
  }
  if (!pair.note.empty()) json["note"] = pair.note;
  if (!pair.texel.empty()) json["texel"] = pair.texel;
  return json;
}

std::string percent_of(std::uint64_t part, std::uint64_t all) {
  return fmt::format("{:.4g} %", all == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

std::string would_pass(const PixelComparison& p) {
  std::string text;
  const auto add = [&](const std::string& option) { text += (text.empty() ? "would pass: " : ", or ") + option; };
  if (p.passing.absolute) add(fmt::format("--fail {}", *p.passing.absolute));
  if (p.passing.relative && *p.passing.relative < 2) add(fmt::format("--failrelative {}", *p.passing.relative));
  // As in idiff, what a share may fail by still warns.
  if (p.passing.percent)
    add(fmt::format("--failpercent {}", *p.passing.percent) +
        (*p.passing.percent > 0 ? fmt::format(" --warnpercent {}", *p.passing.percent) : ""));
  if (p.passing.hard) add(fmt::format("--hardfail {}", *p.passing.hard));
  add(fmt::format("--allowfailures {}", p.passing.allow_failures));
  return text;
}

std::string class_line(const PairResult& pair) {
  const ClassTally& t = pair.page.tally;
  return fmt::format("identical {}, rounding {}, tie {}, tie? {}, unbounded {}, unexplained {}", grouped(t.identical), grouped(t.rounding),
                     grouped(t.tie), grouped(pair.unproven_ties), grouped(t.unbounded), grouped(t.unexplained));
}

}  // namespace

Json diff_document(const std::vector<PairResult>& pairs, const PixelThresholds& thresholds, const std::vector<VerifyInput>& inputs,
                   const RunInfo& run) {
  Json document = document_head("diff", inputs);
  document["verdict"] = to_string(worst_verdict(pairs));
  const auto limit = [](const PixelLimit& l) {
    return Json{{"absolute", l.absolute}, {"relative", l.relative}, {"percent", l.percent}, {"hard", optional_number(l.hard)}};
  };
  document["thresholds"] = {
      {"fail", limit(thresholds.fail)}, {"warn", limit(thresholds.warn)}, {"allow_failures", thresholds.allow_failures}};
  document["jobs"] = Json::array();
  ClassTally total;
  std::uint64_t unproven_ties = 0;
  for (const PairResult& pair : pairs) {
    document["jobs"].push_back(to_json(pair));
    total += pair.page.tally;
    unproven_ties += pair.unproven_ties;
  }
  document["total"] = tally_json(total, unproven_ties);
  document["run"] = to_json(run);
  return document;
}

std::vector<std::string> pair_lines(const PairResult& pair, const PixelThresholds& thresholds) {
  if (pair.status != PairStatus::compared) return {pair.problem};
  const PixelComparison& p = pair.pixels;
  std::vector<std::string> lines;
  if (p.differing == 0) {
    lines.push_back("every value is the same");
  } else {
    lines.push_back(fmt::format("mean error {:.6g}, RMS error {:.6g}, PSNR {}", p.mean_error, p.rms_error,
                                p.psnr_db ? fmt::format("{:.4f} dB", *p.psnr_db) : "–"));
    lines.push_back(fmt::format("max error {:.6g} at ({}, {}) {}, largest relative error {:.6g}", p.max_error, p.max_x, p.max_y,
                                channel_name(p), p.max_relative));
    lines.push_back(fmt::format("{} of {} texels differ ({}), {} over {:g}", grouped(p.differing), grouped(p.pixels),
                                percent_of(p.differing, p.pixels), grouped(p.fail.over), thresholds.fail.absolute));
  }
  if (pair.device.empty()) {
    if (p.differing > 0) lines.push_back(would_pass(p));
  } else {
    lines.push_back(class_line(pair));
    const char* caveat =
        pair.bounds_proven ? "" : (pair.bound_origin == "measured" ? " (rests on a measured bound: no proof)" : " (no proof)");
    lines.push_back(fmt::format("device {}, bounds {}{}", pair.device, pair.bounds, caveat));
    if (pair.unproven_ties > 0)
      lines.push_back(
          "tie?: a rounding or a tie, not proven: that needs the draws (--draws FILE.draws, or a golden with its draws beside it)");
    if (!pair.page.diagnosis.empty()) lines.push_back(pair.page.diagnosis);
  }
  if (!pair.note.empty()) lines.push_back("note: " + pair.note);
  if (!pair.texel.empty()) lines.push_back(pair.texel);
  return lines;
}

std::string diff_junit(const std::vector<PairResult>& pairs, const PixelThresholds& thresholds,
                       const std::vector<std::string>& unused_waivers) {
  std::size_t failures = 0, errors = 0;
  std::string cases;
  for (const PairResult& pair : pairs) {
    std::string text;
    for (const std::string& line : pair_lines(pair, thresholds)) text += line + "\n";
    cases += fmt::format("  <testcase classname=\"etalon diff\" name=\"{}\">", escaped(pair.name));
    const std::string first = escaped(text.substr(0, text.find('\n')));
    if (pair.verdict == PairVerdict::bad_input) {
      ++errors;
      cases += fmt::format("<error message=\"{}\">{}</error>", first, escaped(text));
    } else if (pair.verdict == PairVerdict::failure || pair.verdict == PairVerdict::sizes_differ) {
      ++failures;
      cases += fmt::format("<failure message=\"{}\">{}</failure>", first, escaped(text));
    } else {
      cases += fmt::format("<system-out>{}</system-out>", escaped(text));
    }
    cases += "</testcase>\n";
  }
  for (const std::string& waiver : unused_waivers) {
    ++failures;
    cases += fmt::format("  <testcase classname=\"etalon diff\" name=\"{0}\"><failure message=\"{0}\"/></testcase>\n", escaped(waiver));
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"etalon diff\" tests=\"{}\" failures=\"{}\" "
      "errors=\"{}\">\n{}</testsuite>\n",
      pairs.size() + unused_waivers.size(), failures, errors, cases);
}

}  // namespace etalon::validation
