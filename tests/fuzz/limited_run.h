// A program run within limits of memory and time, and how it ended.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace etalon::test {

struct RunLimits {
  std::uint64_t memory_bytes = std::uint64_t{4} << 30;  ///< of address space (RLIMIT_AS); 0: none, as a program under a sanitizer needs
  unsigned seconds = 10;                                ///< of processor time, all threads together; and 12 times as much of the clock
};

struct RunResult {
  int exit_code = -1;            ///< -1 where a signal ended it
  int signal = 0;                ///< that ended it
  bool timed_out = false;        ///< killed at a limit of time
  double seconds = 0;            ///< of processor time
  std::uint64_t peak_bytes = 0;  ///< of resident memory
  std::string errors;            ///< standard error, at most 4 kB
};

/// Runs command[0], looked for in PATH, without input; standard output is dropped. WriteError where no process can be made; a program that is not
/// there ends with exit code 127.
[[nodiscard]] RunResult run_limited(const std::vector<std::string>& command, const RunLimits& limits,
                                    const std::filesystem::path& errors_path);

/// The same for a function in a copy of this process, which ends with the code that it returns: a program without the cost of its start. This
/// process must have no other thread.
[[nodiscard]] RunResult run_limited(const std::function<int()>& body, const RunLimits& limits, const std::filesystem::path& errors_path);

}  // namespace etalon::test
