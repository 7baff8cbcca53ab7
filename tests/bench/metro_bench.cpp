#include "tests/bench/metro_bench.h"

#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/io/atomic_file.h"
#include "core/io/mesh_file.h"
#include "tests/bench/child.h"
#include "tests/bench/simplify_way.h"
#include "tests/bench/timing.h"
#include "validation/metrics/metro.h"
#include "validation/report/json_report.h"

namespace etalon::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSamples = 1'000'000;  // of edges, and again of faces: what MeshLab means by its number
constexpr int kRepetitions = 4;

std::string filter(int from, int to, double most) {
  return fmt::format(R"( <filter name="Hausdorff Distance">
  <Param type="RichMesh" value="{}" name="SampledMesh"/>
  <Param type="RichMesh" value="{}" name="TargetMesh"/>
  <Param type="RichBool" value="false" name="SaveSample"/>
  <Param type="RichBool" value="true" name="SampleVert"/>
  <Param type="RichBool" value="true" name="SampleEdge"/>
  <Param type="RichBool" value="false" name="SampleFauxEdge"/>
  <Param type="RichBool" value="true" name="SampleFace"/>
  <Param type="RichInt" value="{}" name="SampleNum"/>
  <Param type="RichAbsPerc" value="{}" min="0" max="{}" name="MaxDist"/>
 </filter>
)",
                     from, to, kSamples, most, most);
}

std::string script(int times, double most) {
  std::string text = "<!DOCTYPE FilterScript>\n<FilterScript>\n";
  for (int i = 0; i < times; ++i) text += filter(0, 1, most) + filter(1, 0, most);
  return text + "</FilterScript>\n";
}

class Meshlab {
 public:
  Meshlab(const ScratchDirectory& scratch, const Mesh& a, const Mesh& b) : scratch_(scratch) {
    io::write_mesh(scratch / "a.ply", a);
    io::write_mesh(scratch / "b.ply", b);
    const double diagonal = bounding_box(a).diagonal();
    io::write_file(scratch / "once.mlx", script(1, diagonal));
    io::write_file(scratch / "more.mlx", script(kRepetitions, diagonal));
  }

  /// CPU seconds of a script and what it said. UnavailableError where it cannot be run.
  double run(const std::string& script_name, std::string& log) const {
    const ChildCost cost =
        run_program({"env", "QT_QPA_PLATFORM=offscreen", "timeout", "300", "xvfb-run", "-a", "meshlabserver", "-i",
                     (scratch_ / "a.ply").string(), "-i", (scratch_ / "b.ply").string(), "-s", (scratch_ / script_name).string()},
                    scratch_ / "meshlab-errors");
    log = cost.output;
    if (cost.exit_code != 0) throw UnavailableError(fmt::format("meshlabserver under xvfb-run ended with exit code {}", cost.exit_code));
    return cost.cpu_seconds;
  }

 private:
  const ScratchDirectory& scratch_;
};

void measure_ours(const Mesh& a, const Mesh& b, MetroSide& ours) {
  const double start = process_cpu_seconds();
  const auto direction = [&](const Mesh& from, const Mesh& to, std::size_t side) {
    const TriangleTree tree(to);
    const validation::DirectedDistance distance = validation::measure_direction(
        from, to, [&](std::span<const Vec3d> points, std::span<SurfacePoint> found) { tree.nearest(points, found); }, ours.samples[side]);
    ours.mean[side] = distance.mean;
    ours.rms[side] = distance.rms;
  };
  direction(a, b, 0);
  direction(b, a, 1);
  ours.seconds.push_back(process_cpu_seconds() - start);
}

void learn_samples(const std::string& log, MetroBenchResult& result) {
  const std::vector<MeshlabAnswer> answers = meshlab_answers(log);
  if (answers.size() < 2) throw UnavailableError("meshlabserver did not report two distances");
  // It repeats its whole log after each filter: the first distance is that of a to b, the last that of b to a.
  const std::array<MeshlabAnswer, 2> of{answers.front(), answers.back()};
  for (std::size_t side = 0; side < 2; ++side) {
    result.meshlab.samples[side] = result.ours.samples[side] = of[side].samples;
    result.meshlab.mean[side] = of[side].mean;
    result.meshlab.rms[side] = of[side].rms;
  }
}

void add_figures(MetroBenchResult& result) {
  Figure time{.title = "time: MeshLab ÷ ours", .goal = 3, .sense = Sense::at_least, .skipped = result.skipped};
  if (result.skipped.empty()) time.values = ratios(result.meshlab.seconds, result.ours.seconds);
  result.figures = {time};
}

Json side_json(const MetroSide& side) {
  const Quartiles spread = quartiles(side.seconds);
  return {{"seconds", {{"median", median(side.seconds)}, {"lower", spread.lower}, {"upper", spread.upper}}},
          {"samples", side.samples},
          {"mean", side.mean},
          {"rms", side.rms}};
}

}  // namespace

std::vector<MeshlabAnswer> meshlab_answers(const std::string& log) {
  std::vector<MeshlabAnswer> answers;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    if (const auto at = line.find("Sampled "); at != std::string::npos && line.find(" pts ") != std::string::npos)
      answers.push_back({.samples = std::strtoull(line.c_str() + at + 8, nullptr, 10)});
    const auto mean = line.find("mean : "), rms = line.find("RMS : ");
    // Of the two lines of figures the first is in model units.
    if (mean != std::string::npos && rms != std::string::npos && !answers.empty() && answers.back().rms == 0) {
      answers.back().mean = std::strtod(line.c_str() + mean + 7, nullptr);
      answers.back().rms = std::strtod(line.c_str() + rms + 6, nullptr);
    }
  }
  return answers;
}

MetroBenchResult measure_metro(const Mesh& a, const Mesh& b, int rounds) {
  MetroBenchResult result{.faces_a = a.face_count(), .faces_b = b.face_count()};
  const int threads = thread_count();
  set_thread_count(1);
  const ScratchDirectory scratch;
  try {
    const Meshlab meshlab(scratch, a, b);
    for (int round = 0; round < rounds; ++round) {
      std::string log;
      const double once = meshlab.run("once.mlx", log);
      if (round == 0) learn_samples(log, result);
      const double more = meshlab.run("more.mlx", log);
      result.meshlab.seconds.push_back((more - once) / (kRepetitions - 1));
      measure_ours(a, b, result.ours);
    }
  } catch (const UnavailableError& error) {
    result.skipped = error.what();
    result.ours.samples = {kSamples, kSamples};
    measure_ours(a, b, result.ours);
  }
  set_thread_count(threads);
  add_figures(result);
  return result;
}

Json metro_document(const MetroBenchResult& result) {
  Json document{{"faces_a", result.faces_a}, {"faces_b", result.faces_b}, {"ours", side_json(result.ours)}};
  if (result.skipped.empty())
    document["meshlab"] = side_json(result.meshlab);
  else
    document["skipped"] = result.skipped;
  document["figures"] = Json::array();
  for (const Figure& figure : result.figures) document["figures"].push_back(figure_json(figure));
  return document;
}

std::string metro_tables(const Json& document) {
  std::string table = fmt::format(
      "**Surface distance**, {} and {} faces, both directions, one thread\n\n"
      "| way | samples | CPU seconds (quartiles) | mean, A to B | RMS, A to B | mean, B to A | RMS, B to A "
      "|\n|---|---|---|---|---|---|---|\n",
      validation::grouped(document.at("faces_a").get<std::uint64_t>()), validation::grouped(document.at("faces_b").get<std::uint64_t>()));
  const auto row = [&](const std::string& title, const Json& side) {
    const Json& seconds = side.at("seconds");
    table += fmt::format("| {} | {} + {} | {:.3f} ({:.3f}–{:.3f}) | {:.6f} | {:.6f} | {:.6f} | {:.6f} |\n", title,
                         validation::grouped(side.at("samples")[0].get<std::uint64_t>()),
                         validation::grouped(side.at("samples")[1].get<std::uint64_t>()), seconds.at("median").get<double>(),
                         seconds.at("lower").get<double>(), seconds.at("upper").get<double>(), side.at("mean")[0].get<double>(),
                         side.at("rms")[0].get<double>(), side.at("mean")[1].get<double>(), side.at("rms")[1].get<double>());
  };
  row("ours", document.at("ours"));
  if (document.contains("meshlab")) row("MeshLab, Hausdorff filter", document.at("meshlab"));
  table += "\nMeshLab puts as many samples on the edges as on the faces, at random.\n";
  return table + "\n" + figure_table(document.at("figures"));
}

}  // namespace etalon::bench
