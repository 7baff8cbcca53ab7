#include "validation/report/json_report.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/draw/renderer.h"
#include "raster/cpu_renderer.h"

namespace etalon::validation {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const ClassTally& tally) {
  Json object = {{"texels", tally.texels}, {"identical", tally.identical}, {"rounding", tally.rounding}, {"tie", tally.tie}};
  object["unbounded"] = tally.unbounded;
  object["unexplained"] = tally.unexplained;
  return object;
}

Json optional_number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json to_json(const ImageDifference& difference) {
  Json object = {{"identical", difference.identical}, {"differing_texels", difference.differing_texels}};
  const bool integer = difference.format.type != ChannelType::half && difference.format.type != ChannelType::float32;
  if (integer)
    object["sse"] = difference.total.sse;
  else
    object["squared_error"] = difference.total.squared_error;
  object["psnr_db"] = optional_number(difference.psnr_db());
  object["max_abs"] = difference.total.max_abs;
  object["max_at"] = difference.total.max_x < 0 ? Json(nullptr) : Json({difference.total.max_x, difference.total.max_y});
  Json histogram = Json::array();
  for (const HistogramBin& bin : difference.histogram) histogram.push_back({bin.low, bin.high, bin.count});
  object["histogram"] = std::move(histogram);
  return object;
}

Json to_json(const WorstTexel& texel) {
  return {{"x", texel.x},           {"y", texel.y},         {"class", texel.texel_class},
          {"cpu", texel.cpu_value}, {"gl", texel.gl_value}, {"explanation", texel.explanation}};
}

Json to_json(const TargetResult& target) {
  Json object = {{"content", target.content}, {"format", target.format}};
  object["difference"] = target.difference ? to_json(*target.difference) : Json(nullptr);
  object["cpu_sha256"] = target.cpu_sha256;
  object["gl_sha256"] = target.gl_sha256.empty() ? Json(nullptr) : Json(target.gl_sha256);
  return object;
}

Json to_json(const CaseResult& item) {
  Json object = {{"model", item.model}, {"view", item.view},     {"sampling", item.sampling},
                 {"width", item.width}, {"height", item.height}, {"triangles", item.triangles}};
  object["covered"] = item.covered;
  if (!item.skipped.empty()) object["skipped"] = item.skipped;
  object.update(to_json(item.tally));
  object["diagnosis"] = item.diagnosis;
  Json targets = Json::array();
  for (const TargetResult& target : item.targets) targets.push_back(to_json(target));
  object["targets"] = std::move(targets);
  Json worst = Json::array();
  for (const WorstTexel& texel : item.worst) worst.push_back(to_json(texel));
  object["worst"] = std::move(worst);
  return object;
}

Json to_json(const JobResult& job) {
  Json object = {{"job", job.job}};
  object.update(to_json(job.tally()));
  if (!job.skipped.empty()) object["skipped"] = job.skipped;
  Json cases = Json::array();
  for (const CaseResult& item : job.cases) cases.push_back(to_json(item));
  object["cases"] = std::move(cases);
  return object;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::string csv_line(const std::vector<std::string>& names, const ClassTally& tally) {
  std::string line;
  for (const std::string& name : names) line += csv_field(name) + ",";
  return line +
         fmt::format("{},{},{},{},{},{}\r\n", tally.texels, tally.identical, tally.rounding, tally.tie, tally.unbounded, tally.unexplained);
}

std::string table_line(const std::string& job, const std::string& scene, std::size_t scene_width, const ClassTally& t) {
  return fmt::format("{:<9}{:<{}}{:>13}{:>13}{:>11}{:>10}{:>11}{:>13}", job, scene, scene_width, grouped(t.texels), grouped(t.identical),
                     grouped(t.rounding), grouped(t.tie), grouped(t.unbounded), grouped(t.unexplained));
}

}  // namespace

std::string grouped(std::uint64_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

Json document_head(const std::string& verb, const std::vector<VerifyInput>& inputs) {
  Json document = {{"schema", fmt::format("etalon/{}/1", verb)}, {"contract", raster::kRasterContractVersion}};
  Json list = Json::array();
  for (const VerifyInput& input : inputs) {
    Json entry = {{"name", input.name}, {"role", input.role}, {"sha256", input.sha256}};
    if (!input.attribution.empty()) entry["attribution"] = input.attribution;
    list.push_back(std::move(entry));
  }
  document["inputs"] = std::move(list);
  return document;
}

std::string to_text(const Json& document) { return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json verify_document(const VerifyResult& result, const RunInfo& run) {
  Json document = document_head("verify", result.inputs);
  document["verdict"] = to_string(verdict(result));
  document["renderers"] = {{"cpu", result.cpu_name}, {"gl", result.gl_name.empty() ? Json(nullptr) : Json(result.gl_name)}};
  document["gl_unavailable"] = result.gl_unavailable.empty() ? Json(nullptr) : Json(result.gl_unavailable);
  document["bounds"] = {{"origin", result.bounds_origin}, {"measured", result.bounds_measured}};
  document["state"] = {{"subtexel_bits", result.state.subtexel_bits},
                       {"snap", to_string(result.state.snap)},
                       {"fill_rule", to_string(result.state.fill_rule)},
                       {"half_rounding", to_string(result.state.half_rounding)}};
  document["notes"] = result.notes;
  for (const std::string& caveat : result.caveats) document["notes"].push_back(caveat);
  Json jobs = Json::array();
  for (const JobResult& job : result.jobs) jobs.push_back(to_json(job));
  document["jobs"] = std::move(jobs);
  document["total"] = to_json(result.total());
  document["run"] = to_json(run);
  return document;
}

std::string verify_csv(const VerifyResult& result) {
  std::string csv = "job,model,view,sampling,texels,identical,rounding,tie,unbounded,unexplained\r\n";
  for (const JobResult& job : result.jobs) {
    for (const CaseResult& item : job.cases) csv += csv_line({job.job, item.model, item.view, item.sampling}, item.tally);
  }
  for (const JobResult& job : result.jobs) csv += csv_line({job.job, "", "", "all"}, job.tally());
  return csv + csv_line({"total", "", "", "all"}, result.total());
}

std::vector<std::string> verify_table(const VerifyResult& result) {
  std::size_t scene_width = 24;
  for (const JobResult& job : result.jobs) {
    for (const CaseResult& item : job.cases) scene_width = std::max(scene_width, item.name().size() + 1);
  }
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{:<9}{:<{}}{:>13}{:>13}{:>11}{:>10}{:>11}{:>13}", "job", "scene", scene_width, "texels", "identical",
                              "rounding", "tie", "unbounded", "unexplained"));
  for (const JobResult& job : result.jobs) {
    if (!job.skipped.empty()) lines.push_back(fmt::format("{:<9}skipped: {}", job.job, job.skipped));
    for (const CaseResult& item : job.cases) {
      lines.push_back(item.skipped.empty() ? table_line(job.job, item.name(), scene_width, item.tally)
                                           : fmt::format("{:<9}{:<{}}skipped: {}", job.job, item.name(), scene_width, item.skipped));
    }
  }
  lines.push_back(table_line("total", "", scene_width, result.total()));
  for (const std::string& caveat : result.caveats) lines.push_back("note: " + caveat);
  return lines;
}

}  // namespace etalon::validation
