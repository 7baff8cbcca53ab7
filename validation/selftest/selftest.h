// etalon selftest: does this build, on this machine, draw the contract's bytes? Needs no data, no file, no OpenGL.
//   arithmetic  float_checks() in this thread and in the worker threads
//   hash        the fixed scenes, by every evaluation, every available SIMD level and several thread counts: one SHA-256, the compiled-in one
//   judge       scenes by chance, every texel against validation/reference, which shares no code with the rasterizer
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/draw/renderer.h"
#include "validation/selftest/drawing.h"
#include "validation/selftest/float_checks.h"
#include "validation/selftest/scene_hash.h"

namespace etalon::validation {

struct HashRun {
  Drawing drawing;
  std::string sha256;
  std::string difference;  ///< the first family, scene and texel that is not the golden one's; empty where the hash is
  double seconds = 0;
};

struct JudgeRun {
  Drawing drawing;
  std::uint64_t texels = 0;
  std::uint64_t values = 0;      ///< texels times targets
  std::uint64_t mismatches = 0;  ///< of the values
  std::string first_mismatch;
};

struct SelftestResult {
  SceneHashes golden;
  std::vector<FloatCheck> arithmetic;  ///< of this thread, and what failed in another
  std::uint64_t threads = 0;           ///< that ran these checks
  std::uint64_t scenes = 0;            ///< of all families
  std::vector<HashRun> hashes;
  std::vector<JudgeRun> judged;
  [[nodiscard]] bool passed() const;
};

struct SelftestOptions {
  bool small = false;                     ///< without the exact and the filtered evaluation; a tenth of the judge's scenes
  std::vector<raster::SimdLevel> levels;  ///< empty: all that are available
  std::vector<int> threads{2, 1, 7, 16};  ///< every level with the first, the best level with each
  std::uint64_t seed = 1;                 ///< of the judged scenes: other seeds, other scenes
  /// What is tested, for tests of the test; the default is raster::CpuRenderer.
  std::function<std::unique_ptr<Renderer>(raster::Evaluation)> make_renderer;

  std::function<void(const std::string& label, int done, int total)> progress = [](const std::string&, int, int) {};
  std::function<void(const SelftestResult&)> arithmetic_done = [](const SelftestResult&) {};
  std::function<void(const HashRun&)> hash_done = [](const HashRun&) {};
  std::function<void()> judge_starts = [] {};
  std::function<void(const JudgeRun&)> judge_done = [](const JudgeRun&) {};
};

/// InputError where a level is not available here. Leaves the process's SIMD level and thread count as they were.
[[nodiscard]] SelftestResult run_selftest(const SelftestOptions& options);

}  // namespace etalon::validation
