// What measuring a scene gives: the times of everything that was timed, by name.
#pragma once

#include <string>
#include <vector>

#include "raster/cpu_renderer.h"
#include "tests/bench/bench_scene.h"
#include "tests/bench/timing.h"

namespace etalon::bench {

// Names of the ways.
inline constexpr const char* kOurs = "ours";  ///< CpuRenderer::render() at the reference level, validation and new images included
inline constexpr const char* kValidation = "validation";          ///< validate(), which is part of it
inline constexpr const char* kRivalDraw = "draw";                 ///< clear, draw, glFinish
inline constexpr const char* kRivalReadBack = "draw, read back";  ///< clear, draw, glReadPixels
inline constexpr const char* kRivalOneFan = "1 fan per bind";
inline constexpr const char* kRivalManyFans = "256 fans per bind";
inline constexpr const char* kRivalAllFans = "all fans in one bind";
inline constexpr const char* kRivalOneByOne = "1 adaptation per bind";
inline constexpr const char* kRivalPacked = "1 pack per bind";
inline constexpr const char* kOursOneByOne = "ours, one by one";
inline constexpr const char* kCopy = "copy";              ///< of half the bytes that the scene reads and writes: copying moves each twice
inline constexpr const char* kGather = "gather, affine";  ///< of the visible texels' lookups
inline constexpr const char* kRandomGather = "gather, random";
inline constexpr const char* kFans = "fans";  ///< the scene of fan_scene()

/// A way of the rival, and what the project wants of the quotient rival's time / our time.
struct RivalWay {
  std::string name;
  double goal = 0;       ///< 0: none
  double differing = 0;  ///< share of the frame's texels in which the images differ
};

struct SceneResult {
  std::string name;
  std::string title;
  SceneWork work;
  raster::EvaluationCounters counters;  ///< of one render()
  std::vector<RivalWay> rivals;
  std::vector<Way> ways;       ///< all that was timed
  std::vector<double> others;  ///< by round: share of all processors' time that other programs took
  std::string gather_method;   ///< empty: no texture

  /// Drops the rounds in which others took more than `most_others`, if `fewest` are left without them. Rounds left.
  std::size_t keep_quiet_rounds(double most_others, std::size_t fewest);
  /// The times of a way; empty where it was not measured.
  [[nodiscard]] std::vector<double> times_of(const std::string& name) const;
};

}  // namespace etalon::bench
