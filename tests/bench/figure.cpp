#include "tests/bench/figure.h"

#include <fmt/format.h>

#include "tests/bench/timing.h"

namespace etalon::bench {
namespace {

using Json = nlohmann::ordered_json;

std::string number(double value) { return fmt::format("{:.{}f}", value, value < 10 ? 3 : 1); }

std::string row(const Json& figure) {
  const std::string title = figure.at("title"), verdict = figure.at("verdict");
  const std::string goal = fmt::format("{} {}", figure.at("sense") == "at least" ? "≥" : "≤", figure.at("goal").get<double>());
  if (verdict == "skipped") return fmt::format("| {} | | {} | skipped: {} |\n", title, goal, figure.at("why").get<std::string>());
  const double value = figure.at("median"), lower = figure.at("lower"), upper = figure.at("upper");
  const std::string spread = lower == upper ? "" : fmt::format(" ({}–{})", number(lower), number(upper));
  return fmt::format("| {} | **{}**{} | {} | {} |\n", title, number(value), spread, goal, verdict);
}

}  // namespace

Json figure_json(const Figure& figure) {
  Json json{{"title", figure.title}};
  json["sense"] = figure.sense == Sense::at_least ? "at least" : "at most";
  json["goal"] = figure.goal;
  if (figure.values.empty()) {
    json["verdict"] = "skipped";
    json["why"] = figure.skipped;
    return json;
  }
  const double value = median(figure.values);
  const Quartiles spread = quartiles(figure.values);
  json["median"] = value;
  json["lower"] = spread.lower;
  json["upper"] = spread.upper;
  json["verdict"] = (figure.sense == Sense::at_least ? value >= figure.goal : value <= figure.goal) ? "met" : "short";
  return json;
}

std::string figure_table(const Json& figures) {
  std::string table = "| figure | measured (quartiles) | wanted | |\n|---|---|---|---|\n";
  for (const Json& figure : figures) table += row(figure);
  return table;
}

}  // namespace etalon::bench
