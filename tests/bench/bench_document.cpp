#include "tests/bench/bench_document.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "validation/report/json_report.h"

namespace etalon::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "etalon/bench/1";

Json spread(const std::vector<double>& values) {
  const Quartiles q = quartiles(values);
  return {{"median", median(values)}, {"lower", q.lower}, {"upper", q.upper}};
}

/// The larger of the medians of copy and affine gather: each of them must be done.
double limit_ms(const SceneResult& result) {
  double limit = 0;
  for (const char* name : {kCopy, kGather})
    if (const auto times = result.times_of(name); !times.empty()) limit = std::max(limit, median(times));
  return limit;
}

Json scene_document(const SceneResult& r) {
  const std::vector<double> ours = r.times_of(kOurs);
  Json scene{{"name", r.name}, {"title", r.title}, {"rounds", ours.size()}};
  scene["work"] = {{"vertices", r.work.vertices},      {"triangles", r.work.triangles},       {"covered_texels", r.work.covered_texels},
                   {"lookups", r.work.lookups},        {"lookup_bytes", r.work.lookup_bytes}, {"input_bytes", r.work.input_bytes},
                   {"frame_bytes", r.work.frame_bytes}};
  scene["counters"] = {{"values", r.counters.values}, {"scalar", r.counters.scalar}, {"exact_path", r.counters.exact_path}};
  for (const Way& way : r.ways) scene["times_ms"][way.name] = spread(way.milliseconds);
  scene["others"] = r.others.empty() ? 0 : median(r.others);
  scene["gather_method"] = r.gather_method;
  scene["limit_ms"] = limit_ms(r);
  scene["ratios"] = Json::array();
  for (const RivalWay& rival : r.rivals) {
    Json ratio{{"rival", rival.name}};
    ratio.update(spread(ratios(r.times_of(rival.name), ours)));
    ratio["goal"] = rival.goal;
    ratio["differing"] = rival.differing;
    scene["ratios"].push_back(ratio);
  }
  return scene;
}

std::string ms(double value) { return fmt::format("{:.{}f}", value, value < 10 ? 2 : value < 100 ? 1 : 0); }

std::string per_mille(double share) { return share == 0 ? "0" : fmt::format("{:.2g} ‰", 1000 * share); }

double median_of(const Json& scene, const std::string& way) { return scene.at("times_ms").at(way).at("median").get<double>(); }

bool has_way(const Json& scene, const std::string& way) { return scene.at("times_ms").contains(way); }

std::string ratio_row(const Json& scene, const Json& ratio, bool first) {
  const double ours = median_of(scene, kOurs), limit = scene.at("limit_ms").get<double>(), goal = ratio.at("goal").get<double>();
  const std::string rival = ratio.at("rival");
  std::string name = scene.at("title");
  if (rival != kRivalDraw) name = fmt::format("{}: {}", first ? name : "the same", rival);
  return fmt::format("| {} | {} | {} | {} | **{:.2f}** ({:.2f}–{:.2f}) | {} | {} | {:.1f} | {} |\n", name, ms(ours),
                     ms(median_of(scene, rival)), has_way(scene, kRivalReadBack) ? ms(median_of(scene, kRivalReadBack)) : "",
                     ratio.at("median").get<double>(), ratio.at("lower").get<double>(), ratio.at("upper").get<double>(),
                     goal > 0 ? fmt::format("≥ {}", goal) : "", ms(limit), ours / limit, per_mille(ratio.at("differing").get<double>()));
}

std::string ratio_table(const Json& document) {
  std::string table =
      "| scene | ours, ms | rival, ms | with read-back, ms | rival ÷ ours (quartiles) | wanted | limit, ms | ours ÷ limit | texels that "
      "differ |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const Json& scene : document.at("scenes")) {
    bool first = true;
    for (const Json& ratio : scene.at("ratios")) {
      if (ratio.at("rival") == kRivalReadBack) continue;
      table += ratio_row(scene, ratio, first);
      first = false;
    }
    if (first) {
      const double ours = median_of(scene, kOurs), limit = scene.at("limit_ms").get<double>();
      table +=
          fmt::format("| {} | {} | | | | | {} | {:.1f} | |\n", scene.at("title").get<std::string>(), ms(ours), ms(limit), ours / limit);
    }
  }
  return table;
}

/// Levels that were timed in any scene, in the order of their first appearance.
std::vector<std::string> levels_of(const Json& document) {
  std::vector<std::string> levels;
  const std::string prefix = std::string(kOurs) + ", ";
  for (const Json& scene : document.at("scenes"))
    for (const auto& [way, times] : scene.at("times_ms").items())
      if (way.starts_with(prefix) && std::ranges::find(levels, way.substr(prefix.size())) == levels.end())
        levels.push_back(way.substr(prefix.size()));
  return levels;
}

std::string stage_table(const Json& document) {
  const std::vector<std::string> levels = levels_of(document);
  const std::string reference = document.at("level");
  std::string head = "| scene | triangles | visible texels | validation, ms | ours, " + reference + ", ms |",
              line = "|---|---|---|---|---|";
  for (const std::string& level : levels) head += " " + level + ", ms |", line += "---|";
  std::string table = head +
                      " copy, ms | gather, affine, ms | gather, random, ms | not by vectors | by wide integers | rounds | others |\n" +
                      line + "---|---|---|---|---|---|---|\n";
  for (const Json& scene : document.at("scenes")) {
    const auto time = [&](const std::string& way) { return has_way(scene, way) ? ms(median_of(scene, way)) : std::string(); };
    const Json& work = scene.at("work");
    table += fmt::format("| {} | {} | {} | {} | {} |", scene.at("title").get<std::string>(),
                         validation::grouped(work.at("triangles").get<std::uint64_t>()),
                         validation::grouped(work.at("covered_texels").get<std::uint64_t>()), time(kValidation), time(kOurs));
    for (const std::string& level : levels) table += " " + time(std::string(kOurs) + ", " + level) + " |";
    const Json& counters = scene.at("counters");
    const double values = std::max(1.0, counters.at("values").get<double>());
    table += fmt::format(" {} | {} | {} | {:.2g} | {:.2g} | {} | {:.0f} % |\n", time(kCopy), time(kGather), time(kRandomGather),
                         counters.at("scalar").get<double>() / values, counters.at("exact_path").get<double>() / values,
                         scene.at("rounds").get<int>(), 100 * scene.at("others").get<double>());
  }
  return table;
}

}  // namespace

Json bench_document(const BenchRun& run, const std::vector<SceneResult>& results) {
  Json document{{"schema", kSchema}};
  document["machine"] = {{"date", run.machine.date},     {"cpu", run.machine.cpu},           {"cores", run.machine.cores},
                         {"system", run.machine.system}, {"compiler", run.machine.compiler}, {"load", run.machine.load}};
  document["threads"] = run.threads;
  document["rival_threads"] = run.rival_threads;
  document["rival"] = run.rival;
  document["level"] = run.level;
  document["scenes"] = Json::array();
  for (const SceneResult& result : results)
    if (!result.times_of(kOurs).empty()) document["scenes"].push_back(scene_document(result));
  return document;
}

std::string bench_tables(const Json& document) {
  try {
    if (document.at("schema") != kSchema) throw InputError(fmt::format("expected a document {}", kSchema));
    const Json& machine = document.at("machine");
    const std::string rival = document.at("rival");
    std::string text = fmt::format(
        "Measured on {}: {}, {} cores, {}, {}; load {:.1f} at the start. Rival: {}, {} threads. Ours: {} threads, level {}.\n\n",
        machine.at("date").get<std::string>(), machine.at("cpu").get<std::string>(), machine.at("cores").get<int>(),
        machine.at("system").get<std::string>(), machine.at("compiler").get<std::string>(), machine.at("load").get<double>(),
        rival.empty() ? "none" : rival, document.at("rival_threads").get<int>(), document.at("threads").get<int>(),
        document.at("level").get<std::string>());
    return text + ratio_table(document) + "\n" + stage_table(document);
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("expected a document {}: {}", kSchema, error.what()));
  }
}

std::string with_tables(const std::string& page, const std::string& tables) {
  const auto begin = page.find(kBlockBegin), end = page.find(kBlockEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin || page.find(kBlockBegin, begin + 1) != std::string::npos ||
      page.find(kBlockEnd, end + 1) != std::string::npos)
    throw InputError("expected the lines that begin and end the measured block once each");
  return page.substr(0, begin) + kBlockBegin + "\n" + tables + "\n" + page.substr(end);
}

}  // namespace etalon::bench
