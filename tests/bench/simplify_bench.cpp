#include "tests/bench/simplify_bench.h"

#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/bench/child.h"
#include "tests/bench/simplify_figures.h"
#include "validation/metrics/metro.h"

namespace etalon::bench {
namespace {

constexpr std::uint64_t kMetroSamples = 1'000'000;

/// Bytes of this process: "VmRSS:" resident now, "VmHWM:" at most so far (that of getrusage() would count the parent's at the fork).
double own_bytes(const std::string& what) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(what)) return 1024 * std::stod(line.substr(what.size()));
  return 0;
}

/// The diagonal of the box when it has grown by 2 % of its diagonal on each side of each axis.
double metro_diagonal(const Mesh& mesh) {
  const BoundingBox box = bounding_box(mesh);
  const double diagonal = box.diagonal();
  double squares = 0;
  for (int k = 0; k < 3; ++k) {
    const double side = (static_cast<double>(box.hi[k]) - box.lo[k]) / diagonal + 2 * 0.02;
    squares += side * side;
  }
  return std::sqrt(squares);
}

struct Call {
  double seconds = 0, peak_bytes = 0;
  std::size_t faces = 0;
};

Call call(const SimplifyBenchOptions& options, const ScratchDirectory& scratch, const std::string& way, std::size_t target_faces,
          bool keep_output) {
  std::vector<std::string> command{options.program, kSimplifyChild, way, (scratch / "input").string(), std::to_string(target_faces)};
  if (keep_output) command.push_back((scratch / way).string());
  const ChildCost cost = run_program(command, scratch / "errors");
  Call result;
  std::istringstream words(cost.output);
  if (cost.exit_code != 0 || !(words >> result.seconds >> result.peak_bytes >> result.faces)) {
    std::ifstream errors(scratch / "errors");
    std::string line;
    std::getline(errors, line);
    throw UnavailableError(fmt::format("{}: ended with exit code {}: {}", way, cost.exit_code, line));
  }
  return result;
}

void measure_distance(const Mesh& mesh, const ScratchDirectory& scratch, WayResult& way) {
  const Mesh simplified = read_raw_mesh(scratch / way.name);
  const validation::SurfaceDistance distance = validation::measure_surfaces(mesh, simplified, {.samples = kMetroSamples});
  way.rms = distance.rms() / distance.diagonal;
  way.mean = distance.mean() / distance.diagonal;
  way.colour_rms = distance.colour_rms();
}

}  // namespace

const WayResult* SimplifySceneResult::way(const std::string& wanted) const {
  for (const WayResult& result : ways)
    if (result.name == wanted) return &result;
  return nullptr;
}

SimplifySceneResult measure_simplification(const SimplifyScene& scene, const Mesh& mesh, const SimplifyBenchOptions& options) {
  SimplifySceneResult result{
      .name = scene.name, .title = scene.title, .faces_in = mesh.face_count(), .metro_diagonal = metro_diagonal(mesh)};
  result.target_faces = static_cast<std::size_t>(scene.ratio * static_cast<double>(mesh.face_count()) + 0.5);
  const ScratchDirectory scratch;
  write_raw_mesh(scratch / "input", mesh);
  for (const std::string& name : scene.ways) {
    const SimplifyWay& way = simplify_way(name);
    result.ways.push_back({.name = name, .title = way.title});
    if (!way.run) result.ways.back().skipped = fmt::format("built without {}", way.absent);
  }
  const auto start = std::chrono::steady_clock::now();
  const int rounds = std::min(options.rounds, scene.most_rounds);
  for (int round = 0; round < rounds; ++round) {
    if (round > 0 && std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > options.seconds) break;
    for (WayResult& way : result.ways) {
      if (!way.skipped.empty()) continue;
      const Call one = call(options, scratch, way.name, result.target_faces, round == 0);
      way.seconds.push_back(one.seconds);
      way.peak_bytes.push_back(one.peak_bytes);
      way.faces = one.faces;
    }
  }
  for (WayResult& way : result.ways)
    if (way.skipped.empty()) measure_distance(mesh, scratch, way);
  result.figures = figures_of(result);
  return result;
}

int simplify_child(const std::vector<std::string>& arguments) {
  if (arguments.size() < 3 || arguments.size() > 4) throw InputError("--simplify-child: expected WAY INPUT FACES [OUTPUT]");
  set_thread_count(1);
  const SimplifyWay& way = simplify_way(arguments[0]);
  if (!way.run) throw InputError(fmt::format("{}: built without {}", way.name, way.absent));
  const double program_bytes = own_bytes("VmRSS:");
  SimplifyOutcome outcome = way.run(read_raw_mesh(arguments[1]), std::stoul(arguments[2]));
  fmt::print("{:.9f} {:.0f} {}\n", outcome.seconds, own_bytes("VmHWM:") - program_bytes, outcome.mesh.face_count());
  if (arguments.size() == 4) write_raw_mesh(arguments[3], outcome.mesh);
  return 0;
}

}  // namespace etalon::bench
