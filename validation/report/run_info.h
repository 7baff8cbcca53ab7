// The circumstances of one run: everything in a document that may differ between two runs on the same input.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace etalon::validation {

struct RunInfo {
  std::string version;  ///< of etalon
  int threads = 0;
  double seconds = 0;              ///< wall clock
  std::uint64_t peak_bytes = 0;    ///< largest resident size of the process so far; 0 where the system does not say
  std::vector<std::string> paths;  ///< inputs as they were given
  std::string device;              ///< the GL device in its own words; empty where none was used
};

/// Fills version, threads, seconds since `start` and peak_bytes.
[[nodiscard]] RunInfo current_run(std::chrono::steady_clock::time_point start);

[[nodiscard]] nlohmann::ordered_json to_json(const RunInfo& run);

/// etalon's version, "0.1.0".
[[nodiscard]] std::string etalon_version();

}  // namespace etalon::validation
