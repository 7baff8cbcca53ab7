#include "core/base/memory_limit.h"

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <fstream>

#include <fmt/format.h>

#include "core/base/error.h"

namespace etalon {
namespace {

/// /proc/self/statm (proc(5)), in bytes.
struct Usage {
  std::uint64_t size = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;
};

Usage current_usage() {
  Usage usage;
  std::ifstream file("/proc/self/statm");
  file >> usage.size >> usage.resident >> usage.shared >> usage.text >> usage.library >> usage.data;
  if (!file) return {};
  const auto page_bytes = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  for (std::uint64_t* value : {&usage.size, &usage.resident, &usage.shared, &usage.data}) *value *= page_bytes;
  return usage;
}

void keep_tighter(std::optional<MemoryLimit>& tightest, MemoryLimit limit) {
  if (!tightest || limit.left_bytes() < tightest->left_bytes()) tightest = std::move(limit);
}

void add_resource_limit(std::optional<MemoryLimit>& tightest, int resource, std::uint64_t used_bytes, const char* name) {
  rlimit limit{};
  if (getrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  keep_tighter(tightest, {limit.rlim_cur, used_bytes, name});
}

/// The groups of this process from its own up to the root; each may have a limit.
void add_group_limits(std::optional<MemoryLimit>& tightest, std::uint64_t used_bytes) {
  std::ifstream groups("/proc/self/cgroup");
  std::string line;
  while (std::getline(groups, line)) {
    if (!line.starts_with("0::/")) continue;
    for (std::string group = line.substr(3);;) {
      std::ifstream file("/sys/fs/cgroup" + group + (group.ends_with('/') ? "" : "/") + "memory.max");
      std::uint64_t bytes = 0;
      if (file >> bytes) keep_tighter(tightest, {bytes, used_bytes, "the control group's limit (memory.max)"});  // "max" is no number
      if (group.size() <= 1) break;
      group.resize(group.rfind('/'));
      if (group.empty()) group = "/";
    }
  }
}

}  // namespace

std::optional<MemoryLimit> memory_limit() {
  const Usage usage = current_usage();
  std::optional<MemoryLimit> tightest;
  add_resource_limit(tightest, RLIMIT_AS, usage.size, "the limit of address space (ulimit -v)");
  add_resource_limit(tightest, RLIMIT_DATA, usage.data, "the limit of data (ulimit -d)");
  add_group_limits(tightest, usage.resident > usage.shared ? usage.resident - usage.shared : 0);
  return tightest;
}

std::string memory_text(std::uint64_t bytes) {
  constexpr std::array<const char*, 4> kUnits = {"KB", "MB", "GB", "TB"};
  double value = static_cast<double>(bytes) / 1000;
  std::size_t unit = 0;
  for (; value >= 999.5 && unit + 1 < kUnits.size(); ++unit) value /= 1000;
  return fmt::format("{:.{}f} {}", value, value < 9.995 ? 2 : value < 99.95 ? 1 : 0, kUnits[unit]);
}

void require_memory(const std::string& subject, std::uint64_t need_bytes) {
  const std::optional<MemoryLimit> limit = memory_limit();
  if (!limit || need_bytes <= limit->left_bytes()) return;
  throw InputError(fmt::format("{}: expected at least {} of memory for it, got {}, left of {}: {}", subject, memory_text(need_bytes),
                               memory_text(limit->left_bytes()), memory_text(limit->limit_bytes), limit->name));
}

}  // namespace etalon
