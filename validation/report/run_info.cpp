#include "validation/report/run_info.h"

#include <sys/resource.h>

#include <cmath>

#include "core/base/parallel.h"

namespace etalon::validation {

std::string etalon_version() { return ETALON_VERSION; }

RunInfo current_run(std::chrono::steady_clock::time_point start) {
  RunInfo run;
  run.version = etalon_version();
  run.threads = thread_count();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  run.seconds = std::round(elapsed.count() * 1000) / 1000;
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) == 0) run.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux: KiB
  return run;
}

nlohmann::ordered_json to_json(const RunInfo& run) {
  return {{"version", run.version},       {"threads", run.threads}, {"seconds", run.seconds},
          {"peak_bytes", run.peak_bytes}, {"paths", run.paths},     {"device", run.device}};
}

}  // namespace etalon::validation
