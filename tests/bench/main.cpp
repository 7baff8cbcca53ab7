// etalon_bench: the CPU renderer beside llvmpipe and beside what memory allows, as ratios of times measured in turns.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/io/atomic_file.h"
#include "core/io/inputs.h"
#include "gpu/context.h"
#include "gpu/probe.h"
#include "tests/bench/adapt_scene.h"
#include "tests/bench/bench_document.h"
#include "tests/bench/bench_options.h"
#include "tests/bench/fan_scene.h"
#include "tests/bench/pair_rival.h"
#include "tests/bench/scene_bench.h"
#include "tests/bench/surface_benches.h"
#include "tests/support/skip.h"

namespace etalon::bench {
namespace {

constexpr int kExitDone = 0, kExitDifferent = 2, kExitInput = 4, kExitUsage = 64;

/// The table without the library's words on the machine, which the tables have too, and on its own build.
class PlainReporter : public benchmark::ConsoleReporter {
 public:
  PlainReporter() : ConsoleReporter(OO_Tabular) {}
  bool ReportContext(const Context& context) override {
    name_field_width_ = context.name_field_width;
    printed_header_ = false;
    prev_counters_.clear();
    return true;
  }
};

std::vector<SceneEntry> all_entries() {
  std::vector<SceneEntry> entries = scene_entries();
  entries.push_back({kFans, "10,000 fans, RG32F map to map", [] { return fan_scene(); }});
  for (const Filter filter : {Filter::linear, Filter::nearest})
    for (const int size : {1024, 256})
      entries.push_back({fmt::format("adapt_{}_{}", to_string(filter), size),
                         fmt::format("texture adaptation, 7,684 → 499 → 7,684 faces, {}² RG32F, {}", size, to_string(filter)),
                         [=] { return adapt_scene(size, filter); },
                         1});  // roundings add up over the passes: what they are, etalon verify says
  return entries;
}

/// What the run found out, scene by scene.
struct Outcome {
  std::vector<SceneResult> results;
  SurfaceResults surfaces;
  int failed = 0;
  int skipped = 0;
};

void skip(Outcome& outcome, const std::string& what, const std::string& why) {
  test::report_skip("bench " + what, why);
  ++outcome.skipped;
}

SceneResult measured(const SceneEntry& entry, BenchScene scene, const BenchOptions& options, const SceneBenchOptions& beside) {
  SceneBench bench(entry, std::move(scene), beside);
  bench.measure_round();  // caches, page tables, worker threads, shaders
  bench.drop_rounds();
  const auto start = std::chrono::steady_clock::now();
  int quiet = 0;
  for (int round = 0; quiet < options.repetitions; ++round) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (round >= kFewestRounds && seconds > options.seconds) break;
    bench.measure_round();
    quiet += bench.result().others.back() <= kMostOthers ? 1 : 0;
  }
  bench.keep_quiet_rounds(kMostOthers, kFewestRounds);
  return bench.result();
}

void check_images(const SceneResult& result, double most_differing, Outcome& outcome) {
  for (const RivalWay& rival : result.rivals) {
    if (rival.differing <= most_differing) continue;
    fmt::print("[etalon] failed: bench {}: {}: {:.2f} % of the texels differ from ours, at most {:.2f} % expected\n", result.name,
               rival.name, 100 * rival.differing, 100 * most_differing);
    ++outcome.failed;
    return;
  }
}

/// One benchmark of Google Benchmark: its time is the median of ours, its counters the ratios.
void run_scene(benchmark::State& state, const SceneEntry& entry, const BenchOptions& options, const SceneBenchOptions& beside,
               Outcome& outcome) {
  for (auto _ : state) {
    std::optional<BenchScene> scene = entry.make();
    if (!scene) {
      skip(outcome, entry.name, "a real input is absent");
      state.SkipWithError("a real input is absent");
      return;
    }
    SceneResult result = measured(entry, std::move(*scene), options, beside);
    const std::vector<double> ours = result.times_of(kOurs);
    state.SetIterationTime(median(ours) / 1000);
    state.counters["rounds"] = static_cast<double>(ours.size());
    for (const RivalWay& rival : result.rivals) state.counters[rival.name] = median(ratios(result.times_of(rival.name), ours));
    check_images(result, entry.most_differing, outcome);
    outcome.results.push_back(std::move(result));
  }
}

std::vector<raster::SimdLevel> levels_beside_reference(bool all) {
  std::vector<raster::SimdLevel> levels = raster::available_simd_levels();
  if (!all) levels = {levels.back()};
  std::erase(levels, reference_level());
  return levels;
}

void write_results(const nlohmann::ordered_json& document, const BenchOptions& options) {
  if (!options.json.empty()) io::write_file(options.json, document.dump(2) + "\n");
  const std::string tables = document.at("scenes").empty() ? "" : bench_tables(document), surfaces = surface_tables(document);
  const std::string textures = stream_tables(document), baking = bake_block(document), joint = joint_block(document);
  if (!options.page.empty()) {
    std::string page(io::read_file(options.page).text());
    if (!tables.empty()) page = with_tables(page, tables);
    if (!surfaces.empty()) page = with_surface_tables(page, surfaces);
    if (!textures.empty()) page = with_stream_tables(page, textures);
    if (!baking.empty()) page = with_bake_tables(page, baking);
    if (!joint.empty()) page = with_joint_tables(page, joint);
    io::write_file(options.page, page);
  }
  if (const std::string picture = surface_picture(document); !options.picture.empty() && !picture.empty())
    io::write_file(options.picture, picture);
  fmt::print("\n{}{}{}{}{}\n", tables, surfaces, textures, baking, joint);
}

int measure(const BenchOptions& options) {
  set_thread_count(options.threads);
  BenchRun run;
  run.machine = this_machine();
  run.threads = options.threads;
  run.rival_threads = options.rival_threads < 0 ? options.threads : options.rival_threads;
  run.level = to_string(reference_level());
  Outcome outcome;
  std::unique_ptr<gpu::Context> context;
  if (!options.only_ours) {
    try {
      context = gpu::make_context({.driver = gpu::Driver::llvmpipe, .threads = run.rival_threads});
      run.rival = gpu::probe(*context).name();
    } catch (const UnavailableError& error) {
      context.reset();
      skip(outcome, "rival", error.what());
    }
  }
  const SceneBenchOptions beside{context.get(), levels_beside_reference(options.all_levels), options.only_ours};
  std::size_t registered = 0;
  for (const SceneEntry& entry : all_entries()) {
    if (!wants(options, entry.name)) continue;
    ++registered;
    const auto body = [&, entry](benchmark::State& state) { run_scene(state, entry, options, beside, outcome); };
    benchmark::RegisterBenchmark(entry.name.c_str(), body)->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);
  }
  PlainReporter reporter;
  if (registered > 0) benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  if (!options.only_ours) {
    MakePairRival make_rival;
    if (context) make_rival = [&](const validation::TerrainProblem& terrain) { return make_gl_pair_rival(*context, terrain); };
    outcome.surfaces = measure_surface_scenes(options, make_rival);
    outcome.skipped += outcome.surfaces.skipped;
    nlohmann::ordered_json document = bench_document(run, outcome.results);
    add_surface_results(outcome.surfaces, document);
    write_results(document, options);
  }
  const std::size_t measured_scenes = outcome.results.size() + outcome.surfaces.measured;
  fmt::print("bench: {} passed, {} failed, {} skipped\n", static_cast<int>(measured_scenes) - outcome.failed, outcome.failed,
             outcome.skipped);
  return outcome.failed > 0 ? kExitDifferent : kExitDone;
}

int run(int argc, char** argv) {
  if (argc > 1 && argv[1] == std::string(kSimplifyChild)) return simplify_child({argv + 2, argv + argc});
  if (argc > 1 && argv[1] == std::string(kQuadtreeChild)) return quadtree_child({argv + 2, argv + argc});
  // Google Benchmark takes its own options out and leaves ours.
  std::vector<std::string> arguments;
  std::vector<char*> theirs{argv[0]};
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]).starts_with("--benchmark_"))
      theirs.push_back(argv[i]);
    else
      arguments.emplace_back(argv[i]);
  }
  BenchOptions options;
  try {
    options = parse_options(arguments);
  } catch (const InputError& error) {
    fmt::print(stderr, "etalon_bench: error: {}\n", error.what());
    return kExitUsage;
  }
  if (options.help) {
    fmt::print("{}", usage());
    return kExitDone;
  }
  if (options.list) {
    for (const SceneEntry& entry : all_entries()) fmt::print("{:20} {}\n", entry.name, entry.title);
    for (const auto& [name, title] : surface_scene_titles()) fmt::print("{:20} {}\n", name, title);
    return kExitDone;
  }
  if (!options.from.empty()) {
    const auto document = nlohmann::ordered_json::parse(io::read_file(options.from).text(), nullptr, false);
    if (!document.is_object() || !document.contains("scenes"))
      throw InputError(fmt::format("{}: expected a document of --json", options.from));
    write_results(document, options);
    return kExitDone;
  }
  int their_count = static_cast<int>(theirs.size());
  benchmark::Initialize(&their_count, theirs.data());
  if (benchmark::ReportUnrecognizedArguments(their_count, theirs.data())) return kExitUsage;
  return measure(options);
}

}  // namespace
}  // namespace etalon::bench

int main(int argc, char** argv) {
  try {
    return etalon::bench::run(argc, argv);
  } catch (const etalon::Error& error) {
    fmt::print(stderr, "etalon_bench: error: {}\n", error.what());
    return etalon::bench::kExitInput;
  }
}
