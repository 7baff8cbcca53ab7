// Mutants of files through `etalon info`: it ends with exit code 0, 1 or 4 within 10 seconds of processor time and 4 GiB, and says what is wrong in one line.
//   etalon_info_mutants [--program ETALON] [--first N] [--count N] [--seed S] [--jobs N] [--seconds S] [--keep FOLDER] FILE|FOLDER…
// Without --program the command's own main() runs in a copy of this process, one at a time, without the quarter of a second of its start.
// Mutant n of seed S is a function of n, S and the files, so a finding can be made again. Exit code 0, or 2 after a finding; the file is kept.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "tests/fuzz/limited_run.h"
#include "tests/fuzz/mutate.h"

/// Of cli/main.cpp.
int etalon_main(int argc, char** argv);

namespace {

namespace fs = std::filesystem;
using namespace etalon;
using namespace etalon::test;

struct Options {
  std::string program;
  std::uint64_t first = 0, count = 100, seed = 1, jobs = 2;
  RunLimits limits;
  fs::path keep = ".";
  std::vector<fs::path> files;
};

struct Tally {
  std::map<int, std::uint64_t> exits;
  std::uint64_t findings = 0, peak_bytes = 0;
  double seconds = 0;  ///< the slowest
  std::mutex mutex;
};

std::uint64_t number_of(const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) throw InputError(fmt::format("expected a number, got '{}'", text));
  return value;
}

void add_files(const fs::path& path, std::vector<fs::path>& files) {
  if (!fs::is_directory(path)) return files.push_back(path);
  std::vector<fs::path> inside;
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (entry.is_regular_file()) inside.push_back(entry.path());
  std::sort(inside.begin(), inside.end());
  files.insert(files.end(), inside.begin(), inside.end());
}

Options parsed(const std::vector<std::string>& words) {
  Options options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto value = [&] {
      if (i + 1 == words.size()) throw InputError(words[i] + ": expected a value");
      return words[++i];
    };
    if (words[i] == "--program")
      options.program = value();
    else if (words[i] == "--count")
      options.count = number_of(value());
    else if (words[i] == "--first")
      options.first = number_of(value());
    else if (words[i] == "--seed")
      options.seed = number_of(value());
    else if (words[i] == "--jobs")
      options.jobs = std::max<std::uint64_t>(1, number_of(value()));
    else if (words[i] == "--seconds")
      options.limits.seconds = static_cast<unsigned>(number_of(value()));
    else if (words[i] == "--keep")
      options.keep = value();
    else
      add_files(words[i], options.files);
  }
  if (options.files.empty()) throw InputError("expected files");
  if (options.program.empty()) options.jobs = 1;
  return options;
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(file), {}};
  if (!file || content.empty()) throw InputError(path.string() + ": expected a file that is not empty");
  return content;
}

/// Nothing, or what is wrong with how it ended on `file`.
std::string complaint(const RunResult& run, const std::string& file) {
  if (run.timed_out) return fmt::format("did not end ({:.1f} s of processor time)", run.seconds);
  if (run.signal != 0) return fmt::format("ended by signal {}", run.signal);
  if (run.exit_code != 0 && run.exit_code != 1 && run.exit_code != 4) return fmt::format("exit code {}", run.exit_code);
  if (run.exit_code != 4) return "";
  if (!run.errors.starts_with("etalon: error: ") || run.errors.find('\n') + 1 != run.errors.size())
    return "more or less than one line of error";
  // InternalError and what a library throws do not name the file; "out of memory" is a request beyond the limit.
  if (run.errors.find(file) == std::string::npos || run.errors.find("internal check") != std::string::npos)
    return "an error that is not the file's";
  return "";
}

RunResult run_info(const std::string& program, const fs::path& path, const RunLimits& limits, const fs::path& errors) {
  std::vector<std::string> command = {program.empty() ? "etalon" : program, "info", "--quiet", path.string()};
  if (!program.empty()) return run_limited(command, limits, errors);
  std::vector<char*> arguments;
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::function<int()> body = [&] { return etalon_main(static_cast<int>(command.size()), arguments.data()); };
  return run_limited(body, limits, errors);
}

/// Makes mutant n in `folder` under its file's own name, so that the extension stays, and runs the program on it.
void attempt(const Options& options, std::uint64_t n, const fs::path& folder, Tally& tally) {
  const fs::path& source = options.files[n % options.files.size()];
  Rng rng(options.seed * 0x9E3779B97F4A7C15ull + n);
  const fs::path path = folder / source.filename();
  std::ofstream(path, std::ios::binary) << mutant_of(content_of(source), rng);
  const RunResult run = run_info(options.program, path, options.limits, folder / "errors");
  const std::string what = complaint(run, path.string());
  const std::lock_guard lock(tally.mutex);
  ++tally.exits[run.signal != 0 ? 128 + run.signal : run.exit_code];
  tally.seconds = std::max(tally.seconds, run.seconds);
  tally.peak_bytes = std::max(tally.peak_bytes, run.peak_bytes);
  if (!what.empty()) {
    ++tally.findings;
    const fs::path kept = options.keep / fmt::format("mutant-{}-{}-{}", options.seed, n, source.filename().string());
    fs::copy_file(path, kept, fs::copy_options::overwrite_existing);
    fmt::print("[etalon] failed: mutant {} of {}: {}: {}\n", n, source.string(), what, kept.string());
    std::fputs(run.errors.c_str(), stdout);
  }
  fs::remove(path);
}

int run(const Options& options) {
  fs::create_directories(options.keep);
  Tally tally;
  std::atomic<std::uint64_t> next{0};
  const auto work = [&](std::uint64_t job) {
    const fs::path folder = fs::temp_directory_path() / fmt::format("etalon-mutants-{}-{}", getpid(), job);
    fs::create_directories(folder);
    for (std::uint64_t n; (n = next++) < options.count;) attempt(options, options.first + n, folder, tally);
    fs::remove_all(folder);
  };
  std::vector<std::thread> workers;
  for (std::uint64_t job = 1; job < options.jobs; ++job) workers.emplace_back(work, job);
  work(0);
  for (std::thread& worker : workers) worker.join();
  fmt::print("{} mutants of {} files:", options.count, options.files.size());
  for (const auto& [code, count] : tally.exits) fmt::print(" exit {}: {};", code, count);
  fmt::print(" slowest {:.2f} s, most memory {:.0f} MiB, {} findings\n", tally.seconds, static_cast<double>(tally.peak_bytes) / 1048576,
             tally.findings);
  return tally.findings == 0 ? 0 : 2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parsed({argv + 1, argv + argc}));
  } catch (const std::exception& error) {
    fmt::print(stderr, "etalon_info_mutants: {}\n", error.what());
    return 64;
  }
}
