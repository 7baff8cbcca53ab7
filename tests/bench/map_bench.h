// Passes over a map that stays: ours, the device's, and reading as many texels from a table.
#pragma once

#include <memory>
#include <string>

#include "gpu/gl_map.h"
#include "tests/bench/bench_scene.h"
#include "tests/bench/limits.h"

namespace etalon::bench {

/// Of their texels.
[[nodiscard]] double differing_share(const Image& a, const Image& b);

class MapBench {
 public:
  /// `context`: of the rival; none: without it.
  MapBench(const MapWork& work, gpu::Context* context);

  void apply_ours(const std::vector<MapPass>& passes);
  /// Until the device has done it.
  void apply_rival(const std::vector<MapPass>& passes);
  /// As many texels as the passes write, gathered affinely from a table of the map's size and stored.
  void run_limit();

  [[nodiscard]] const SceneWork& work() const { return work_; }
  [[nodiscard]] std::string gather_method() const { return gather_->method(); }
  /// Of the map's texels, after one run of the packs on both sides.
  [[nodiscard]] double differing_share() const { return differing_share_; }

 private:
  gpu::Context* context_;
  std::unique_ptr<ResidentMap> ours_;
  std::unique_ptr<gpu::GlMap> rival_;
  std::unique_ptr<GatherLimit> gather_;
  std::uint64_t gather_runs_ = 0;
  SceneWork work_;
  double differing_share_ = 0;
};

}  // namespace etalon::bench
