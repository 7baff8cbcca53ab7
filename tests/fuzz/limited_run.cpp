#include "tests/fuzz/limited_run.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "core/base/error.h"

namespace etalon::test {
namespace {

using Clock = std::chrono::steady_clock;

void put_under(const RunLimits& limits, const char* errors_path) {
  const int nothing = open("/dev/null", O_RDWR);
  const int errors = open(errors_path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (nothing < 0 || errors < 0 || dup2(nothing, STDIN_FILENO) < 0 || dup2(nothing, STDOUT_FILENO) < 0 || dup2(errors, STDERR_FILENO) < 0)
    _exit(126);
  const rlimit no_core{0, 0}, memory{limits.memory_bytes, limits.memory_bytes}, time{limits.seconds, limits.seconds + 1};
  if (setrlimit(RLIMIT_CORE, &no_core) != 0 || setrlimit(RLIMIT_CPU, &time) != 0) _exit(126);
  if (limits.memory_bytes != 0 && setrlimit(RLIMIT_AS, &memory) != 0) _exit(126);
}

std::string beginning_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(4096, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

}  // namespace

RunResult run_limited(const std::vector<std::string>& command, const RunLimits& limits, const std::filesystem::path& errors_path) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const std::function<int()> become = [&] {
    execvp(arguments[0], arguments.data());
    _exit(127);
    return 127;
  };
  return run_limited(become, limits, errors_path);
}

RunResult run_limited(const std::function<int()>& body, const RunLimits& limits, const std::filesystem::path& errors_path) {
  std::fflush(nullptr);  // or the child would write it again
  const Clock::time_point start = Clock::now();
  const pid_t child = fork();
  if (child < 0) throw WriteError(fmt::format("fork: {}", std::strerror(errno)));
  if (child == 0) {
    put_under(limits, errors_path.c_str());
    const int code = body();
    // Not exit(): libraries wait at their end for threads that a copy of a process does not have.
    std::fflush(nullptr);
    _exit(code);
  }
  RunResult result;
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, WNOHANG, &usage) == 0) {
    // A loaded machine may keep a sound program waiting; one that sleeps for ever uses no processor time.
    if (!result.timed_out && Clock::now() - start > std::chrono::seconds(12 * limits.seconds)) {
      result.timed_out = true;
      kill(child, SIGKILL);
    }
    usleep(1000);
  }
  const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  result.seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  result.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  result.timed_out = result.timed_out || result.signal == SIGXCPU;
  result.errors = beginning_of(errors_path);
  return result;
}

}  // namespace etalon::test
