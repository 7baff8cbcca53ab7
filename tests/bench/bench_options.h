// The command line of etalon_bench.
#pragma once

#include <string>
#include <vector>

namespace etalon::bench {

struct BenchOptions {
  std::vector<std::string> scenes;  ///< parts of names; none: all scenes
  int repetitions = 15;             ///< rounds of a scene in which other programs take at most kMostOthers
  double seconds = 12;              ///< of a scene's rounds, after which no further one begins, but never fewer than kFewestRounds
  int threads = 2;                  ///< of ours, and of the rival where nothing else is asked
  int rival_threads = -1;           ///< llvmpipe's workers, 0: it draws in the calling thread; -1: as many as ours
  bool all_levels = false;          ///< ours at each SIMD level, not only at the reference and the best one
  bool only_ours = false;
  bool long_scenes = false;  ///< also the scenes that take minutes: how simplification grows up to 10,000,000 faces
  bool list = false;
  bool help = false;
  std::string json;     ///< file for the results
  std::string page;     ///< Markdown file whose measured block is rewritten
  std::string picture;  ///< SVG file for how simplification grows
  std::string from;     ///< results of an earlier run to make the tables from; nothing is measured
};

inline constexpr int kFewestRounds = 5;
/// Share of all processors' time: a core for a tenth of the time, of two.
inline constexpr double kMostOthers = 0.05;

/// InputError "OPTION: expected …, got …" for anything unknown, incomplete or out of range.
[[nodiscard]] BenchOptions parse_options(const std::vector<std::string>& arguments);

[[nodiscard]] std::string usage();

/// Whether the options ask for a scene of this name.
[[nodiscard]] bool wants(const BenchOptions& options, const std::string& scene);

}  // namespace etalon::bench
