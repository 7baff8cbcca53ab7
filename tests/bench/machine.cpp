#include "tests/bench/machine.h"

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

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

}  // namespace etalon::bench
