// The results as a document `etalon/bench/1`, and the tables that are made from it, and from nothing else.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/bench/machine.h"
#include "tests/bench/scene_result.h"

namespace etalon::bench {

/// What all scenes were measured with.
struct BenchRun {
  Machine machine;
  int threads = 2;
  int rival_threads = 2;
  std::string rival;  ///< the device's own words; empty: none
  std::string level;  ///< the reference level of ours
};

/// {schema, machine, threads, rival_threads, rival, level, scenes: [{name, title, rounds, work, counters, times: {way: {median, lower, upper}}, others, limit_ms,
/// ratios: [{rival, median, lower, upper, goal, differing}]}]}. Times in milliseconds; ratios are quotients of the same round's times, and
/// their median. Scenes without rounds are left out.
[[nodiscard]] nlohmann::ordered_json bench_document(const BenchRun& run, const std::vector<SceneResult>& results);

/// The document as Markdown: when and where, the ratios, the times by SIMD level. InputError where `document` is none of bench_document().
[[nodiscard]] std::string bench_tables(const nlohmann::ordered_json& document);

/// `page` with what stands between the lines kBlockBegin and kBlockEnd replaced by `tables`. InputError where it has not exactly one of each.
[[nodiscard]] std::string with_tables(const std::string& page, const std::string& tables);

inline constexpr const char* kBlockBegin = "<!-- measured: begin (etalon_bench --page) -->\n";
inline constexpr const char* kBlockEnd = "<!-- measured: end -->\n";

}  // namespace etalon::bench
