// One scene measured: ours, the rival's ways, and the limits, in turns.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gpu/context.h"
#include "raster/simd_level.h"
#include "tests/bench/bench_scene.h"
#include "tests/bench/gl_rival.h"
#include "tests/bench/limits.h"
#include "tests/bench/machine.h"
#include "tests/bench/map_bench.h"
#include "tests/bench/scene_result.h"

namespace etalon::bench {

/// AVX2 where it is available, since llvmpipe too works on 256 bits; else the best level.
[[nodiscard]] raster::SimdLevel reference_level();
/// "ours, avx512": render() at another level.
[[nodiscard]] std::string ours_at(raster::SimdLevel level);

/// What is measured beside ours.
struct SceneBenchOptions {
  gpu::Context* context = nullptr;        ///< of the rival; none: without it
  std::vector<raster::SimdLevel> levels;  ///< of ours, beside the reference level
  bool only_ours = false;                 ///< nothing else, for a profiler
};

/// A scene set up to be measured. Makes and keeps everything that the ways use.
class SceneBench {
 public:
  SceneBench(const SceneEntry& entry, BenchScene scene, const SceneBenchOptions& options);

  /// Times each way once, and what other programs take meanwhile.
  void measure_round();
  /// SceneResult::keep_quiet_rounds.
  std::size_t keep_quiet_rounds(double most_others, std::size_t fewest) { return result_.keep_quiet_rounds(most_others, fewest); }
  /// Forgets the rounds measured so far, and sets by the first of them how many runs a turn has.
  void drop_rounds();
  [[nodiscard]] const SceneResult& result() const { return result_; }

 private:
  void add(const std::string& name, std::function<void()> run) { result_.ways.push_back({name, std::move(run), {}}); }
  void add_ours(const std::vector<raster::SimdLevel>& levels);
  void add_rival(gpu::Context& context);
  void add_fan_rival(gpu::Context& context);
  void add_map_work(const SceneBenchOptions& options);
  void add_limits();
  void add_rival_way(const std::string& name, const Image& ours, const Image& theirs, std::function<void()> run);

  BenchScene scene_;
  std::vector<Image> images_;
  SceneResult result_;
  OtherPrograms others_;
  std::unique_ptr<GlRival> rival_;
  std::unique_ptr<FanRival> fan_rival_;
  std::unique_ptr<MapBench> map_bench_;
  std::unique_ptr<CopyLimit> copy_;
  std::vector<std::unique_ptr<GatherLimit>> gathers_;
};

}  // namespace etalon::bench
