#include "validation/selftest/selftest.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

#include "core/base/float_environment.h"
#include "core/base/parallel.h"
#include "raster/cpu_renderer.h"
#include "validation/selftest/judged_scenes.h"

namespace etalon::validation {
namespace {

using raster::Evaluation;
using raster::SimdLevel;

constexpr int kJudgedScenes = 400;
constexpr int kJudgedScenesSmall = 40;

// The process's settings, given back at the end.
class Settings {
 public:
  Settings() : level_(raster::simd_level()), threads_(thread_count()) {}
  ~Settings() {
    raster::set_simd_level(level_);
    set_thread_count(threads_);
  }
  Settings(const Settings&) = delete;
  Settings& operator=(const Settings&) = delete;

 private:
  SimdLevel level_;
  int threads_;
};

std::unique_ptr<Renderer> renderer_of(const SelftestOptions& options, Evaluation evaluation) {
  if (options.make_renderer) return options.make_renderer(evaluation);
  return std::make_unique<raster::CpuRenderer>(evaluation);
}

void check_arithmetic(const SelftestOptions& options, SelftestResult& result) {
  {
    const DefaultFloatEnvironment environment;
    result.arithmetic = float_checks();
  }
  constexpr std::size_t kBlocks = 64;
  std::vector<std::thread::id> threads(kBlocks);
  std::vector<std::vector<FloatCheck>> checks(kBlocks);
  set_thread_count(*std::max_element(options.threads.begin(), options.threads.end()));
  parallel_for(kBlocks, [&](std::size_t n) {
    threads[n] = std::this_thread::get_id();
    checks[n] = float_checks();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // or one thread has done it all before another is awake
  });
  for (const std::vector<FloatCheck>& block : checks)
    for (const FloatCheck& check : block)
      if (!check.passed()) result.arithmetic.push_back({check.name + ", in a worker thread", check.expected, check.got});
  result.threads = std::set<std::thread::id>(threads.begin(), threads.end()).size();
}

std::vector<Drawing> planned_drawings(const SelftestOptions& options, const std::vector<SimdLevel>& levels) {
  std::vector<Drawing> drawings;
  const int first = options.threads.front();
  if (!options.small) drawings = {{Evaluation::exact, {}, first}, {Evaluation::filtered, {}, first}};
  for (const SimdLevel level : levels)
    for (const int threads : options.threads)
      if (threads == first || level == levels.back()) drawings.push_back({Evaluation::vectorised, level, threads});
  return drawings;
}

// Where the drawing leaves the golden's way: the family, and the texel in which it differs from the exact path of this machine.
std::string difference_of(const SceneHashes& got, const SceneHashes& golden, const std::vector<SceneFamily>& families,
                          const SelftestOptions& options, const Drawing& drawing) {
  const std::string name = golden.first_difference(got);
  const auto family = std::find_if(families.begin(), families.end(), [&](const SceneFamily& f) { return f.name == name; });
  if (family == families.end()) return name.empty() ? "" : fmt::format("family {}: not among the scenes of this build", name);
  raster::CpuRenderer exact(Evaluation::exact);
  const std::unique_ptr<Renderer> renderer = renderer_of(options, drawing.evaluation);
  for (const FixedScene& scene : family->scenes) {
    const Comparison comparison = compare(scene, exact.render(scene.list, scene.frame), renderer->render(scene.list, scene.frame));
    if (comparison.mismatches > 0) return fmt::format("family {}, {}", name, comparison.first_mismatch);
  }
  return fmt::format("family {}: drawn like the exact path of this machine, so that one differs too, or the scene itself", name);
}

HashRun hash_run(const SelftestOptions& options, const std::vector<SceneFamily>& families, const SceneHashes& golden,
                 const Drawing& drawing) {
  HashRun run{.drawing = drawing};
  apply(drawing);
  const auto start = std::chrono::steady_clock::now();
  const std::unique_ptr<Renderer> renderer = renderer_of(options, drawing.evaluation);
  const std::string label = fmt::format("{} {}", to_string(drawing.evaluation), level_name(drawing));
  const SceneHashes hashes =
      hash_scenes(families, *renderer, [&](int done) { options.progress(label, done, static_cast<int>(families.size())); });
  run.sha256 = hashes.all;
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (hashes != golden) run.difference = difference_of(hashes, golden, families, options, drawing);
  return run;
}

std::vector<JudgeRun> judge_runs(const SelftestOptions& options, const std::vector<SimdLevel>& levels) {
  std::vector<JudgeRun> runs;
  const int threads = options.threads.front();
  runs.push_back({.drawing = {Evaluation::filtered, {}, threads}, .first_mismatch = {}});
  for (const SimdLevel level : levels) runs.push_back({.drawing = {Evaluation::vectorised, level, threads}, .first_mismatch = {}});
  const int count = options.small ? kJudgedScenesSmall : kJudgedScenes;
  for (int n = 0; n < count; ++n) {
    const FixedScene scene = judged_scene(options.seed * 1'000'000 + static_cast<std::uint64_t>(n));
    const Judgement judgement = judge_scene(scene);
    for (JudgeRun& run : runs) {
      apply(run.drawing);
      const Comparison comparison =
          compare(scene, judgement, renderer_of(options, run.drawing.evaluation)->render(scene.list, scene.frame));
      run.texels += comparison.texels;
      run.values += comparison.values;
      if (run.mismatches == 0) run.first_mismatch = comparison.first_mismatch;
      run.mismatches += comparison.mismatches;
    }
    options.progress("the judge", n + 1, count);
  }
  return runs;
}

}  // namespace

bool SelftestResult::passed() const {
  return std::all_of(arithmetic.begin(), arithmetic.end(), [](const FloatCheck& check) { return check.passed(); }) &&
         std::all_of(hashes.begin(), hashes.end(), [&](const HashRun& run) { return run.sha256 == golden.all; }) &&
         std::all_of(judged.begin(), judged.end(), [](const JudgeRun& run) { return run.mismatches == 0; });
}

SelftestResult run_selftest(const SelftestOptions& options) {
  const Settings settings;
  const std::vector<SimdLevel> levels = options.levels.empty() ? raster::available_simd_levels() : options.levels;
  for (const SimdLevel level : levels) raster::set_simd_level(level);
  SelftestResult result;
  result.golden = golden_scene_hashes();
  check_arithmetic(options, result);
  const std::vector<SceneFamily> families = fixed_scenes();
  for (const SceneFamily& family : families) result.scenes += family.scenes.size();
  options.arithmetic_done(result);
  for (const Drawing& drawing : planned_drawings(options, levels)) {
    result.hashes.push_back(hash_run(options, families, result.golden, drawing));
    options.hash_done(result.hashes.back());
  }
  options.judge_starts();
  result.judged = judge_runs(options, levels);
  for (const JudgeRun& run : result.judged) options.judge_done(run);
  return result;
}

}  // namespace etalon::validation
