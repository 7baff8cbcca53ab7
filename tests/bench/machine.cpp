#include "tests/bench/machine.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>
#include <utility>

namespace etalon::bench {
namespace {

/// The rest of the first line that begins with `key`, without separators and quotes around it.
std::string line_after(const char* path, const std::string& key) {
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    if (!line.starts_with(key)) continue;
    const auto begin = line.find_first_not_of(" \t:=\"", key.size());
    const auto end = line.find_last_not_of(" \t\"");
    if (begin != std::string::npos && begin <= end) return line.substr(begin, end - begin + 1);
  }
  return "unknown";
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", &utc);
  return text;
}

}  // namespace

Machine this_machine() {
  Machine machine;
  machine.date = today();
  machine.cpu = line_after("/proc/cpuinfo", "model name");
  machine.system = line_after("/etc/os-release", "PRETTY_NAME");
#if defined(__clang__)
  machine.compiler = "clang " __clang_version__;
#elif defined(__GNUC__)
  machine.compiler = "g++ " __VERSION__;
#else
  machine.compiler = "unknown";
#endif
  machine.cores = static_cast<int>(std::thread::hardware_concurrency());
  double load = 0;
  if (getloadavg(&load, 1) == 1) machine.load = load;
  return machine;
}

double OtherPrograms::share() {
  // The first line of /proc/stat: time of all processors in user, nice, system, idle, iowait, irq, softirq, steal.
  std::ifstream file("/proc/stat");
  std::string name;
  double ticks[8] = {};
  file >> name;
  for (double& t : ticks) file >> t;
  if (!file) return 0;
  const double per_second = static_cast<double>(sysconf(_SC_CLK_TCK));
  double total = 0;
  for (const double t : ticks) total += t / per_second;
  const double busy = total - (ticks[3] + ticks[4]) / per_second;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) / 1e6; };
  const double own = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  const double others = (busy - std::exchange(busy_seconds_, busy)) - (own - std::exchange(own_seconds_, own));
  const double elapsed = total - std::exchange(total_seconds_, total);
  return elapsed > 0 ? std::clamp(others / elapsed, 0.0, 1.0) : 0;
}

}  // namespace etalon::bench
