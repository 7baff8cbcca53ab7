#include "validation/report/run_info.h"

#include <cmath>
#include <fstream>

#include "core/base/parallel.h"

namespace etalon::validation {

std::string etalon_version() { return ETALON_VERSION; }

namespace {

// Not getrusage()'s ru_maxrss, which begins at the resident size of the process that started this one.
std::uint64_t peak_resident_bytes() {
  std::ifstream status("/proc/self/status");
  std::string word;
  std::uint64_t kibibytes = 0;
  while (status >> word)
    if (word == "VmHWM:" && status >> kibibytes) return kibibytes * 1024;
  return 0;
}

}  // namespace

RunInfo current_run(std::chrono::steady_clock::time_point start) {
  RunInfo run;
  run.version = etalon_version();
  run.threads = thread_count();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  run.seconds = std::round(elapsed.count() * 1000) / 1000;
  run.peak_bytes = peak_resident_bytes();
  return run;
}

nlohmann::ordered_json to_json(const RunInfo& run) {
  return {{"version", run.version},       {"threads", run.threads}, {"seconds", run.seconds},
          {"peak_bytes", run.peak_bytes}, {"paths", run.paths},     {"device", run.device}};
}

}  // namespace etalon::validation
