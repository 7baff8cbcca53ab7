#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tests/bench/joint_bench.h"
#include "tests/bench/timing.h"
#include "validation/report/json_report.h"

namespace etalon::bench {
namespace {

using Json = nlohmann::ordered_json;
using validation::grouped;

constexpr double kGiB = 1024.0 * 1024 * 1024;

std::vector<double> rival_ratios(const JointBenchResult& result, std::vector<double> rival_pair, const std::vector<double>& exhaustive) {
  for (double& seconds : rival_pair) seconds *= static_cast<double>(result.pairs());
  return ratios(rival_pair, exhaustive);
}

Json joint_json(const JointBenchResult& result) {
  Json json{{"name", result.name},
            {"title", result.title},
            {"meshes", result.meshes},
            {"textures", result.textures},
            {"evaluations", result.evaluations},
            {"level_seconds", result.level_seconds},
            {"marginal_seconds", median(result.marginal)},
            {"exhaustive_seconds", median(result.exhaustive)},
            {"rounds", result.exhaustive.size()},
            {"compared", result.compared},
            {"equal", result.equal}};
  if (result.rival_pair.empty())
    json["skipped"] = result.skipped;
  else
    json["rival"] = {{"pairs", result.rival_pairs}, {"pair_seconds", median(result.rival_pair)}, {"differing", result.differing}};
  return json;
}

/// Nanoseconds for each point and binary digit of their number: level where time is n·log n.
double per_point_and_digit(double seconds, double points) { return 1e9 * seconds / (points * std::log2(points)); }

std::string quadtree_table(const Json& trees) {
  std::string table =
      "**The quadtree** of `make terrain`, order of removal, CPU seconds of one thread; peak of the whole process\n\n"
      "| heights | points | s | ns ÷ (n·log₂ n) | peak, MB | bytes a point |\n|---|---|---|---|---|---|\n";
  for (const Json& tree : trees) {
    const int side = tree.at("side");
    const double points = static_cast<double>(side) * side, seconds = tree.at("seconds"), peak = tree.at("peak_bytes");
    table += fmt::format("| {}² | {} | {:.3f} | {:.1f} | {:.0f} | {:.0f} |\n", side, grouped(static_cast<std::uint64_t>(points)), seconds,
                         per_point_and_digit(seconds, points), peak / 1e6, peak / points);
  }
  return table + "\n";
}

}  // namespace

std::vector<Figure> joint_figures(const JointScenes& scenes) {
  std::vector<Figure> figures;
  for (const JointBenchResult& result : scenes.joint) {
    figures.push_back({.title = result.title + ": marginal analysis, s", .values = result.marginal, .goal = 1, .sense = Sense::at_most});
    figures.push_back({.title = result.title + ": all pairs, s", .values = result.exhaustive, .goal = 10, .sense = Sense::at_most});
    Figure rival{.title = result.title + ": all pairs drawn and read back ÷ ours", .goal = 10, .skipped = result.skipped};
    Figure rival_cpu = rival;
    rival_cpu.title += ", CPU seconds";
    if (!result.rival_pair.empty()) {
      rival.values = rival_ratios(result, result.rival_pair, result.exhaustive);
      rival_cpu.values = rival_ratios(result, result.rival_pair_cpu, result.exhaustive_cpu);
    }
    figures.push_back(rival), figures.push_back(rival_cpu);
    figures.push_back({.title = result.title + ": pairs that differ from full renderings",
                       .values = {static_cast<double>(result.compared - result.equal)},
                       .goal = 0,
                       .sense = Sense::at_most});
  }
  for (const QuadtreeCost& tree : scenes.quadtrees)
    if (tree.side == 4097)
      figures.push_back({.title = "quadtree of 4097²: peak, GiB", .values = {tree.peak_bytes / kGiB}, .goal = 4, .sense = Sense::at_most});
  return figures;
}

Json joint_document(const JointScenes& scenes) {
  Json document{{"scenes", Json::array()}, {"quadtrees", Json::array()}, {"figures", Json::array()}};
  for (const JointBenchResult& result : scenes.joint) document["scenes"].push_back(joint_json(result));
  for (const QuadtreeCost& tree : scenes.quadtrees)
    document["quadtrees"].push_back({{"side", tree.side}, {"seconds", tree.order_seconds}, {"peak_bytes", tree.peak_bytes}});
  for (const Figure& figure : joint_figures(scenes)) document["figures"].push_back(figure_json(figure));
  return document;
}

std::string joint_tables(const Json& document) {
  std::string text;
  if (!document.at("scenes").empty())
    text +=
        "**Searches of one view**, 640 × 480, a tenth of the terrain's triangles seen; wall-clock seconds once the levels exist\n\n"
        "| terrain | pairs | levels, s | marginal analysis, s | its evaluations | all pairs, s | ms a pair | rival, ms a pair | its pairs "
        "| its texels off by more than 2 | full renderings with the same bytes |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Json& scene : document.at("scenes")) {
    const auto pairs = scene.at("meshes").get<std::uint64_t>() * scene.at("textures").get<std::uint64_t>();
    const double all = scene.at("exhaustive_seconds");
    text += fmt::format("| {} | {} | {:.2f} | {:.3f} | {} | {:.3f} | {:.3f} |", scene.at("title").get<std::string>(), grouped(pairs),
                        scene.at("level_seconds").get<double>(), scene.at("marginal_seconds").get<double>(),
                        scene.at("evaluations").get<int>(), all, 1e3 * all / static_cast<double>(pairs));
    if (scene.contains("rival")) {
      const Json& rival = scene.at("rival");
      text += fmt::format(" {:.3f} | {} | {:.2f} % |", 1e3 * rival.at("pair_seconds").get<double>(), rival.at("pairs").get<int>(),
                          100 * rival.at("differing").get<double>());
    } else {
      text += fmt::format(" skipped: {} | | |", scene.at("skipped").get<std::string>());
    }
    text += fmt::format(" {} of {} |\n", scene.at("equal").get<int>(), scene.at("compared").get<int>());
  }
  if (!document.at("scenes").empty()) text += "\n";
  if (!document.at("quadtrees").empty()) text += quadtree_table(document.at("quadtrees"));
  return document.at("figures").empty() ? text : text + figure_table(document.at("figures")) + "\n";
}

std::string quadtree_picture(const Json& document) {
  struct Point {
    double points, seconds, peak;
  };
  std::vector<Point> trees;
  for (const Json& tree : document.at("quadtrees")) {
    const double side = tree.at("side");
    trees.push_back({side * side, tree.at("seconds"), tree.at("peak_bytes")});
  }
  if (trees.size() < 2) return "";
  constexpr double kLeft = 80, kTop = 20, kDecade = 130, kWidth = 3 * kDecade, kHeight = 5 * kDecade;
  const auto x = [&](double points) { return kLeft + (std::log10(points) - 4.5) * kDecade; };
  const auto y = [&](double value) { return kTop + kHeight - (std::log10(value) + 2) * kDecade; };  // 10 ms, or 10 MB, to 1000 s
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"13\">\n"
      "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"white\"/>\n",
      kLeft + kWidth + 80, kTop + kHeight + 64);
  for (const Point& tree : trees)
    svg += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\">{4:.0f}²</text>\n",
        x(tree.points), kTop, kTop + kHeight, kTop + kHeight + 18, std::sqrt(tree.points));
  for (int e = -2; e <= 3; ++e)
    svg += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}H{2:.1f}\" stroke=\"#ddd\"/><text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:g} s</text>"
        "<text x=\"{6:.1f}\" y=\"{4:.1f}\">{7:g} {8}</text>\n",
        kLeft, y(std::pow(10, e)), kLeft + kWidth, kLeft - 6, y(std::pow(10, e)) + 4, std::pow(10, e), kLeft + kWidth + 6,
        e < 0 ? std::pow(10, e + 3) : std::pow(10, e), e < 0 ? "MB" : "GB");
  const auto line = [&](auto value, const char* stroke) {
    std::string path;
    for (const Point& tree : trees) path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x(tree.points), y(value(tree)));
    svg += fmt::format("<path d=\"{}\" fill=\"none\" {}/>\n", path, stroke);
  };
  const double unit = trees[0].seconds / (trees[0].points * std::log2(trees[0].points));
  line([](const Point& p) { return p.seconds; }, "stroke=\"#1f5fbf\" stroke-width=\"1.5\"");
  line([&](const Point& p) { return unit * p.points * std::log2(p.points); }, "stroke=\"#1f5fbf\" stroke-dasharray=\"4 4\"");
  line([](const Point& p) { return p.peak / 1e9; }, "stroke=\"#c8501e\" stroke-width=\"1.5\"");
  for (const Point& tree : trees)
    svg += fmt::format(
        "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"3.5\" fill=\"#1f5fbf\"/><circle cx=\"{0:.1f}\" cy=\"{2:.1f}\" r=\"3.5\" "
        "fill=\"#c8501e\"/>\n",
        x(tree.points), y(tree.seconds), y(tree.peak / 1e9));
  return svg + fmt::format(
                   "<text x=\"{:.1f}\" y=\"{:.1f}\"><tspan fill=\"#1f5fbf\">time</tspan> (dashed: n·log n through the first) · <tspan "
                   "fill=\"#c8501e\">peak memory</tspan>, by heights</text>\n</svg>\n",
                   kLeft, kTop + kHeight + 44);
}

}  // namespace etalon::bench
