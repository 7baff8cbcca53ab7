#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "tests/bench/bake_bench.h"
#include "tests/bench/timing.h"
#include "validation/report/json_report.h"

namespace etalon::bench {
namespace {

using Json = nlohmann::ordered_json;
using validation::grouped;

Json time_json(const BakeTime& time) {
  return {{"title", time.title},       {"faces_in", time.faces_in}, {"vertices_in", time.vertices_in},
          {"map", time.map},           {"bake", median(time.bake)}, {"simplify", median(time.simplify)},
          {"own", time.own_seconds()}, {"rounds", time.bake.size()}};
}

Json times_json(const std::vector<BakeTime>& times) {
  Json list = Json::array();
  for (const BakeTime& time : times) list.push_back(time_json(time));
  return list;
}

Json rows_json(const std::vector<ViewQuality>& rows) {
  Json list = Json::array();
  for (const ViewQuality& row : rows)
    list.push_back({{"title", row.title},
                    {"faces", row.faces},
                    {"bytes", row.bytes},
                    {"frame_db", row.frame_db},
                    {"both_db", row.both_db},
                    {"outline_share", row.outline_share}});
  return list;
}

std::string rows_table(const Json& rows) {
  std::string table =
      "| model | faces | bytes (PLY, PNG) | whole frames, dB | of that error, in outlines | where both show it, dB "
      "|\n|---|---|---|---|---|---|\n";
  for (const Json& row : rows) {
    const std::uint64_t bytes = row.at("bytes");
    table += fmt::format("| {} | {} | {} | {:.2f} | {:.1f} % | **{:.2f}** |\n", row.at("title").get<std::string>(),
                         grouped(row.at("faces").get<std::uint64_t>()), bytes > 0 ? grouped(bytes) : "", row.at("frame_db").get<double>(),
                         100 * row.at("outline_share").get<double>(), row.at("both_db").get<double>());
  }
  return table + "\n";
}

std::string times_table(const Json& times) {
  std::string table =
      "| scan | faces | map | `simplify_mesh`, s | `bake_scan`, s | on top, s | on top, ns a vertex |\n|---|---|---|---|---|---|---|\n";
  for (const Json& time : times)
    table += fmt::format("| {} | {} | {}² | {:.3f} | {:.3f} | {:.3f} | {:.0f} |\n", time.at("title").get<std::string>(),
                         grouped(time.at("faces_in").get<std::uint64_t>()), time.at("map").get<int>(), time.at("simplify").get<double>(),
                         time.at("bake").get<double>(), time.at("own").get<double>(),
                         1e9 * time.at("own").get<double>() / time.at("vertices_in").get<double>());
  return table + "\n";
}

std::string rival_table(const Json& rival) {
  std::string table = fmt::format("**Whole processes**: {}, 1,000 faces, 512²\n\n", rival.at("title").get<std::string>());
  if (rival.contains("skipped")) return table + fmt::format("skipped: {}\n\n", rival.at("skipped").get<std::string>());
  table += "| program | seconds | CPU seconds |\n|---|---|---|\n";
  for (const auto& [name, key] :
       {std::pair("`etalon bake`, decimation included", "ours"), std::pair("the same with `--fill sampled --gutter 0`", "sampled"),
        std::pair("`meshlabserver`, decimated before", "meshlab")})
    table += fmt::format("| {} | {:.2f} | {:.2f} |\n", name, rival.at(key).at("wall").get<double>(), rival.at(key).at("cpu").get<double>());
  return table + "\n" + rows_table(rival.at("rows"));
}

/// One panel of straight lines over decades: seconds by size.
struct Panel {
  double left = 0;
  int first_decade = 0, decades = 0;
  const char* caption = "";
  bool dashed = true;  ///< the line in proportion
};
constexpr double kTop = 20, kDecade = 120, kBottom = kTop + 4 * kDecade;

std::string panel(const Panel& at, const std::vector<std::pair<double, Json>>& points) {
  const auto x = [&](double size) { return at.left + (std::log10(size) - at.first_decade) * kDecade; };
  const auto y = [](double seconds) { return kBottom - (std::log10(std::max(seconds, 1e-2)) + 2) * kDecade; };
  std::string svg;
  for (int e = 0; e <= at.decades; ++e)
    svg += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\">10<tspan "
        "dy=\"-5\" font-size=\"10\">{4}</tspan></text>\n",
        at.left + e * kDecade, kTop, kBottom, kBottom + 18, at.first_decade + e);
  for (int e = -2; e <= 2; ++e)
    svg += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}H{2:.1f}\" stroke=\"#ddd\"/><text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\">{5} s</text>\n",
        at.left, y(std::pow(10, e)), at.left + at.decades * kDecade, at.left - 6, y(std::pow(10, e)) + 4, std::pow(10, e));
  constexpr std::pair<const char*, const char*> kLines[] = {{"simplify", "#888888"}, {"bake", "#1f5fbf"}, {"own", "#c8501e"}};
  for (const auto& [key, colour] : kLines) {
    std::string path;
    for (const auto& [size, time] : points) {
      const double seconds = time.at(key);
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x(size), y(seconds));
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", x(size), y(seconds), colour);
    }
    svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n", path, colour);
  }
  if (at.dashed) {
    const auto& [size, time] = points.back();
    const double own = time.at("own"), least = points.front().first;
    svg += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#c8501e\" stroke-dasharray=\"4 4\"/>\n", x(size), y(own),
                       x(least), y(own * least / size));
  }
  return svg + fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", at.left + at.decades * kDecade / 2,
                           kBottom + 38, at.caption);
}

}  // namespace

std::vector<Figure> bake_figures(const BakeBenchResult& result) {
  std::vector<Figure> figures;
  for (const BakeTime& time : result.times)
    figures.push_back({.title = fmt::format("{}: time of baking ÷ simplification alone", time.title),
                       .values = ratios(time.bake, time.simplify),
                       .goal = 1.5,
                       .sense = Sense::at_most});
  for (const BakeQuality& quality : result.qualities)
    for (std::size_t row = 1; row <= quality.shares.size(); ++row)
      figures.push_back(
          {.title = fmt::format("{}: {} against vertex colours, dB where both show it", quality.title, quality.rows[row].title),
           .values = {quality.rows[row].both_db - quality.rows[0].both_db},
           .goal = 3});
  for (const BakeRivalResult& rival : result.rivals) {
    Figure wall{.title = fmt::format("{}: time of MeshLab's process ÷ ours", rival.title), .goal = 1, .skipped = rival.skipped};
    Figure cpu = wall, quality = wall, sampled_wall = wall, sampled_near = wall, sampled_better = wall;
    cpu.title = fmt::format("{}: its CPU time ÷ ours", rival.title);
    quality.title = fmt::format("{}: ours − MeshLab's better lookup, dB where both show it", rival.title);
    sampled_wall.title = fmt::format("{}: time of MeshLab's process ÷ ours, `--fill sampled --gutter 0`", rival.title);
    sampled_near.title = fmt::format("{}: ours, `--fill sampled --gutter 0` − MeshLab's, both nearest, dB where both show it", rival.title);
    sampled_better.title =
        fmt::format("{}: the better of ours, `--fill sampled --gutter 0` − MeshLab's better lookup, dB where both show it", rival.title);
    quality.goal = sampled_near.goal = sampled_better.goal = 0;
    if (rival.skipped.empty()) {
      wall.values = ratios(rival.meshlab_wall, rival.our_wall);
      cpu.values = ratios(rival.meshlab_cpu, rival.our_cpu);
      const double nearest = rival.rows.at(1).both_db, better = std::max(nearest, rival.rows.at(2).both_db);
      quality.values = {rival.rows.at(0).both_db - better};
      sampled_wall.values = ratios(rival.meshlab_wall, rival.sampled_wall);
      sampled_near.values = {rival.rows.at(3).both_db - nearest};
      sampled_better.values = {std::max(rival.rows.at(3).both_db, rival.rows.at(4).both_db) - better};
    }
    for (const Figure& figure : {wall, cpu, quality, sampled_wall, sampled_near, sampled_better}) figures.push_back(figure);
  }
  return figures;
}

Json bake_document(const BakeBenchResult& result) {
  Json document{{"times", times_json(result.times)},
                {"growth_faces", times_json(result.growth_faces)},
                {"growth_maps", times_json(result.growth_maps)}};
  document["qualities"] = Json::array();
  for (const BakeQuality& quality : result.qualities) {
    Json shares = Json::array();
    for (const auto& share : quality.shares)
      shares.push_back({{"map", share.map}, {"hit", share.hit}, {"averaged", share.averaged}, {"filled", share.filled}});
    document["qualities"].push_back({{"title", quality.title}, {"rows", rows_json(quality.rows)}, {"shares", shares}});
  }
  document["rivals"] = Json::array();
  for (const BakeRivalResult& rival : result.rivals) {
    Json json{{"title", rival.title}};
    if (rival.skipped.empty()) {
      json["ours"] = {{"wall", median(rival.our_wall)}, {"cpu", median(rival.our_cpu)}};
      json["sampled"] = {{"wall", median(rival.sampled_wall)}, {"cpu", median(rival.sampled_cpu)}};
      json["meshlab"] = {{"wall", median(rival.meshlab_wall)}, {"cpu", median(rival.meshlab_cpu)}};
      json["rows"] = rows_json(rival.rows);
    } else {
      json["skipped"] = rival.skipped;
    }
    document["rivals"].push_back(json);
  }
  document["figures"] = Json::array();
  for (const Figure& figure : bake_figures(result)) document["figures"].push_back(figure_json(figure));
  return document;
}

std::string bake_tables(const Json& document) {
  std::string text;
  if (!document.at("times").empty())
    text += "**Baking beside simplification alone**, to 1,000 faces\n\n" + times_table(document.at("times"));
  for (const Json& quality : document.at("qualities")) {
    text += fmt::format("**The 24 views**, {}² each: {}\n\n", kBakeViews_px, quality.at("title").get<std::string>()) +
            rows_table(quality.at("rows"));
    for (const Json& share : quality.at("shares"))
      text += fmt::format("Texels of the {}² map: {:.1f} % hit ({:.1f} % averaged), {:.1f} % filled.\n\n", share.at("map").get<int>(),
                          100 * share.at("hit").get<double>(), 100 * share.at("averaged").get<double>(),
                          100 * share.at("filled").get<double>());
  }
  for (const Json& rival : document.at("rivals")) text += rival_table(rival);
  if (!document.at("figures").empty()) text += figure_table(document.at("figures")) + "\n";
  if (!document.at("growth_faces").empty()) text += "**How time grows with the scan**\n\n" + times_table(document.at("growth_faces"));
  if (!document.at("growth_maps").empty()) text += "**How time grows with the map**\n\n" + times_table(document.at("growth_maps"));
  return text;
}

std::string bake_growth_picture(const Json& document) {
  std::vector<std::pair<double, Json>> faces, texels;
  for (const Json& time : document.at("growth_faces")) faces.emplace_back(time.at("faces_in").get<double>(), time);
  for (const Json& time : document.at("growth_maps")) texels.emplace_back(std::pow(time.at("map").get<double>(), 2), time);
  if (faces.size() < 2 || texels.size() < 2) return "";
  constexpr double kSecond = 60 + 3 * kDecade + 90, kWidth = kSecond + 4 * kDecade + 20, kHeight = kBottom + 80;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"13\">\n"
      "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"white\"/>\n",
      kWidth, kHeight);
  svg += panel({60, 4, 3, "faces of the scan, map of 512²"}, faces);
  svg += panel({kSecond, 4, 4, "texels of the map, scan of 282,944 faces", false}, texels);
  svg += fmt::format(
      "<text x=\"60\" y=\"{0:.1f}\"><tspan fill=\"#888888\">simplification alone</tspan> · <tspan fill=\"#1f5fbf\">baking</tspan> · <tspan "
      "fill=\"#c8501e\">what baking takes on top</tspan>; dashed: in proportion, through its last point</text>\n",
      kHeight - 14);
  return svg + "</svg>\n";
}

std::string with_bake_tables(const std::string& page, const std::string& tables) {
  const auto begin = page.find(kBakeBlockBegin), end = page.find(kBakeBlockEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw InputError("expected the lines that begin and end the measured block of baking");
  return page.substr(0, begin) + kBakeBlockBegin + "\n" + tables + "\n" + page.substr(end);
}

}  // namespace etalon::bench
