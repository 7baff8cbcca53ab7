#include "tests/bench/simplify_document.h"

#include <cmath>

#include <fmt/format.h>

#include "tests/bench/timing.h"
#include "validation/report/json_report.h"

namespace etalon::bench {
namespace {

using Json = nlohmann::ordered_json;
using validation::grouped;

constexpr const char* kGrowth = "simplify-growth-";

Json way_json(const WayResult& way) {
  Json json{{"name", way.name}, {"title", way.title}};
  if (!way.skipped.empty()) {
    json["skipped"] = way.skipped;
    return json;
  }
  const Quartiles spread = quartiles(way.seconds);
  json["faces"] = way.faces;
  json["seconds"] = {{"median", median(way.seconds)}, {"lower", spread.lower}, {"upper", spread.upper}};
  json["rounds"] = way.seconds.size();
  json["peak_bytes"] = median(way.peak_bytes);
  json["rms_of_diagonal"] = way.rms;
  json["mean_of_diagonal"] = way.mean;
  json["colour_rms"] = way.colour_rms ? Json(*way.colour_rms) : Json(nullptr);
  return json;
}

bool is_growth(const Json& scene) { return scene.at("name").get<std::string>().starts_with(kGrowth); }

std::string way_table(const Json& scene) {
  std::string table = fmt::format(
      "**{}** (`{}`), {} → {} faces\n\n| way | faces | CPU seconds (quartiles) | peak, MB | RMS, % | mean, % | colour RMS |\n"
      "|---|---|---|---|---|---|---|\n",
      scene.at("title").get<std::string>(), scene.at("name").get<std::string>(), grouped(scene.at("faces_in").get<std::uint64_t>()),
      grouped(scene.at("target_faces").get<std::uint64_t>()));
  for (const Json& way : scene.at("ways")) {
    const std::string title = way.at("title");
    if (way.contains("skipped")) {
      table += fmt::format("| {} | skipped: {} | | | | | |\n", title, way.at("skipped").get<std::string>());
      continue;
    }
    const Json& seconds = way.at("seconds");
    const double lower = seconds.at("lower"), upper = seconds.at("upper");
    const std::string spread = lower < upper ? fmt::format(" ({:.3f}–{:.3f})", lower, upper) : "";
    table += fmt::format("| {} | {} | {:.3f}{} | {:.0f} | {:.4f} | {:.4f} | {} |\n", title, grouped(way.at("faces").get<std::uint64_t>()),
                         seconds.at("median").get<double>(), spread, way.at("peak_bytes").get<double>() / 1e6,
                         100 * way.at("rms_of_diagonal").get<double>(), 100 * way.at("mean_of_diagonal").get<double>(),
                         way.at("colour_rms").is_null() ? "" : fmt::format("{:.4f}", way.at("colour_rms").get<double>()));
  }
  return table + "\n";
}

/// Nanoseconds for each face and binary digit of their number: level where time is n·log n.
double per_face_and_digit(double seconds, double faces) { return 1e9 * seconds / (faces * std::log2(faces)); }

std::string growth_table(const Json& scenes) {
  // The first scene has every way.
  std::string table, head = "| faces |", line = "|---|";
  for (const Json& scene : scenes) {
    if (!is_growth(scene)) continue;
    const double faces = scene.at("faces_in");
    if (table.empty())
      for (const Json& way : scene.at("ways")) {
        head += fmt::format(" {}: s | ns ÷ (n·log₂ n) |", way.at("title").get<std::string>());
        line += "---|---|";
      }
    table += fmt::format("| {} |", grouped(scene.at("faces_in").get<std::uint64_t>()));
    for (const Json& way : scene.at("ways")) {
      const double seconds = way.at("seconds").at("median");
      table += fmt::format(" {:.3f} | {:.1f} |", seconds, per_face_and_digit(seconds, faces));
    }
    table += "\n";
  }
  return table.empty() ? "" : fmt::format("**How time grows**: `make knot` to 10 %, n faces\n\n{}\n{}\n{}\n", head, line, table);
}

}  // namespace

Json simplify_document(const std::vector<SimplifySceneResult>& results) {
  Json scenes = Json::array();
  for (const SimplifySceneResult& result : results) {
    Json scene{{"name", result.name}, {"title", result.title}, {"faces_in", result.faces_in}, {"target_faces", result.target_faces}};
    scene["ways"] = Json::array();
    for (const WayResult& way : result.ways) scene["ways"].push_back(way_json(way));
    scene["figures"] = Json::array();
    for (const Figure& figure : result.figures) scene["figures"].push_back(figure_json(figure));
    scenes.push_back(scene);
  }
  return scenes;
}

std::string simplify_tables(const Json& scenes) {
  std::string text;
  for (const Json& scene : scenes) {
    if (is_growth(scene)) continue;
    text += way_table(scene);
    if (!scene.at("figures").empty()) text += figure_table(scene.at("figures")) + "\n";
  }
  return text + growth_table(scenes);
}

std::string growth_picture(const Json& scenes) {
  struct Point {
    double faces, seconds;
  };
  std::vector<std::pair<std::string, std::vector<Point>>> lines;
  for (const Json& scene : scenes) {
    if (!is_growth(scene)) continue;
    for (const Json& way : scene.at("ways")) {
      const std::string title = way.at("title");
      auto line = std::find_if(lines.begin(), lines.end(), [&](const auto& l) { return l.first == title; });
      if (line == lines.end()) line = lines.insert(lines.end(), {title, {}});
      line->second.push_back({scene.at("faces_in"), way.at("seconds").at("median")});
    }
  }
  if (lines.empty() || lines[0].second.size() < 2) return "";
  constexpr double kLeft = 70, kTop = 20, kDecade = 140, kWidth = 3.2 * kDecade, kHeight = 4.4 * kDecade;
  const auto x = [&](double faces) { return kLeft + (std::log10(faces) - 3.9) * kDecade; };
  const auto y = [&](double seconds) { return kTop + kHeight - (std::log10(seconds) + 2.4) * kDecade; };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"13\">\n"
      "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"white\"/>\n",
      kLeft + kWidth + 20, kTop + kHeight + 40);
  for (int e = 4; e <= 7; ++e)
    svg += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\">{4}</text>\n",
        x(std::pow(10, e)), kTop, kTop + kHeight, kTop + kHeight + 18, grouped(static_cast<std::uint64_t>(std::pow(10, e))));
  for (int e = -2; e <= 2; ++e)
    svg += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}H{2:.1f}\" stroke=\"#ddd\"/><text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\">{5} s</text>\n", kLeft,
        y(std::pow(10, e)), kLeft + kWidth, kLeft - 6, y(std::pow(10, e)) + 4, std::pow(10, e));
  const char* colours[] = {"#1f5fbf", "#c8501e", "#2a8a3e", "#7a3fa0"};
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const auto& points = lines[l].second;
    const double unit = points[0].seconds / (points[0].faces * std::log2(points[0].faces));
    std::string path, model;
    for (const Point& p : points) {
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x(p.faces), y(p.seconds));
      model += fmt::format("{}{:.1f} {:.1f}", model.empty() ? "M" : "L", x(p.faces), y(unit * p.faces * std::log2(p.faces)));
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", x(p.faces), y(p.seconds), colours[l % 4]);
    }
    svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n", path, colours[l % 4]);
    svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-dasharray=\"4 4\"/>\n", model, colours[l % 4]);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\">{}</text>\n", kLeft + 12, kTop + 18 + 18 * static_cast<double>(l),
                       colours[l % 4], lines[l].first);
  }
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">faces of the input; dashed: n·log n through the first point</text>\n", kLeft + 12,
                     kTop + kHeight - 10);
  return svg + "</svg>\n";
}

}  // namespace etalon::bench
