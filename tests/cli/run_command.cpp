#include "tests/cli/run_command.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace etalon::test {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void become_etalon(const std::vector<std::string>& arguments, const CommandOptions& options, int out, int err) {
  if (!options.folder.empty() && chdir(options.folder.c_str()) != 0) _exit(125);
  if (!options.stdout_path.empty()) out = open(options.stdout_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  for (const std::string& setting : options.environment) putenv(const_cast<char*>(setting.c_str()));
  if (options.file_size_limit_bytes >= 0) {
    signal(SIGXFSZ, SIG_IGN);
    const auto limit = static_cast<rlim_t>(options.file_size_limit_bytes);
    const rlimit size{limit, limit};
    setrlimit(RLIMIT_FSIZE, &size);
  }
  if (options.as_nobody && geteuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0)) _exit(124);
  std::vector<char*> argv{const_cast<char*>("etalon")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(ETALON_PROGRAM, argv.data());
  _exit(126);
}

// Reads both pipes to their ends; a second pipe left unread would block the program.
void collect(int out, int err, CommandResult& result, pid_t child, int interrupt_after_ms) {
  std::array<pollfd, 2> pipes{{{out, POLLIN, 0}, {err, POLLIN, 0}}};
  const auto start = std::chrono::steady_clock::now();
  bool interrupted = interrupt_after_ms < 0;
  int open_pipes = 2;
  while (open_pipes > 0) {
    const auto elapsed = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - start).count();
    if (!interrupted && elapsed >= interrupt_after_ms) {
      kill(child, SIGINT);
      interrupted = true;
    }
    const int wait_ms = interrupted ? -1 : static_cast<int>(std::max<long long>(interrupt_after_ms - elapsed, 0));
    if (poll(pipes.data(), pipes.size(), wait_ms) <= 0) continue;
    for (std::size_t i = 0; i < pipes.size(); ++i) {
      if (pipes[i].fd < 0 || pipes[i].revents == 0) continue;
      std::array<char, 65536> buffer{};
      const ssize_t count = read(pipes[i].fd, buffer.data(), buffer.size());
      if (count > 0) {
        (i == 0 ? result.out : result.err).append(buffer.data(), static_cast<std::size_t>(count));
      } else {
        pipes[i].fd = -1;
        --open_pipes;
      }
    }
  }
}

}  // namespace

std::vector<std::string> CommandResult::error_lines() const {
  std::vector<std::string> lines;
  std::istringstream stream(err);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

CommandResult run_etalon(const std::vector<std::string>& arguments, const CommandOptions& options) {
  std::array<int, 2> out{};
  std::array<int, 2> err{};
  if (pipe(out.data()) != 0 || pipe(err.data()) != 0) throw std::runtime_error("pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork");
  if (child == 0) become_etalon(arguments, options, out[1], err[1]);
  close(out[1]);
  close(err[1]);
  CommandResult result;
  collect(out[0], err[0], result, child, options.interrupt_after_ms);
  close(out[0]);
  close(err[0]);
  int status = 0;
  waitpid(child, &status, 0);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

ScratchFolder::ScratchFolder() {
  std::string pattern = (fs::temp_directory_path() / "etalon-test-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("mkdtemp");
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::permissions(path_, fs::perms::owner_all, ignored);
  fs::remove_all(path_, ignored);
}

std::string ScratchFolder::file(const std::string& name, const std::string& content) const {
  const fs::path file = path_ / name;
  std::ofstream(file, std::ios::binary) << content;
  return file.string();
}

std::vector<std::string> ScratchFolder::listing() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(path_)) names.push_back(fs::relative(entry.path(), path_).string());
  std::sort(names.begin(), names.end());
  return names;
}

void check_refused(const std::vector<std::string>& arguments, int exit_code, const ScratchFolder& folder, const std::string& mentions,
                   CommandOptions options) {
  std::string shown;
  for (const std::string& argument : arguments) shown += argument + " ";
  CAPTURE(shown);
  const std::vector<std::string> before = folder.listing();
  options.folder = folder.path();
  const CommandResult result = run_etalon(arguments, options);
  CAPTURE(result.err);
  CHECK(result.exit_code == exit_code);
  REQUIRE(result.error_lines().size() == 1);
  CHECK(result.error_lines()[0].rfind("etalon: error: ", 0) == 0);
  CHECK(result.error_lines()[0].find(mentions) != std::string::npos);
  CHECK(folder.listing() == before);
}

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string square_obj() {
  return "v -1 -1 0\nv 1 -1 0\nv 1 1 0.5\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
}

}  // namespace etalon::test
