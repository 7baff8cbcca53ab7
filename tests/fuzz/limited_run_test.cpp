// The runner of mutants sees every way in which a program can end wrongly.
#include "tests/fuzz/limited_run.h"

#include <doctest/doctest.h>

#include <unistd.h>

#include <csignal>
#include <fstream>
#include <set>

#include "tests/fuzz/mutate.h"

using namespace etalon;
using namespace etalon::test;

namespace {

namespace fs = std::filesystem;

class Scratch {
 public:
  Scratch() : path_(fs::temp_directory_path() / ("etalon-limited-" + std::to_string(getpid()))) { fs::create_directories(path_); }
  ~Scratch() { fs::remove_all(path_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  fs::path operator/(const char* name) const { return path_ / name; }

 private:
  fs::path path_;
};

RunResult shell(const std::string& script, const RunLimits& limits = {}) {
  const Scratch scratch;
  return run_limited({"sh", "-c", script}, limits, scratch / "errors");
}

}  // namespace

TEST_CASE("limited run: exit codes, signals, errors, and a program that is not there") {
  const RunResult plain = shell("echo wrong >&2; exit 3");
  CHECK(plain.exit_code == 3);
  CHECK(plain.signal == 0);
  CHECK(plain.errors == "wrong\n");
  CHECK_FALSE(plain.timed_out);
  const RunResult killed = shell("kill -SEGV $$");
  CHECK(killed.exit_code == -1);
  CHECK(killed.signal == SIGSEGV);
  const Scratch scratch;
  CHECK(run_limited({(scratch / "nothing").string()}, {}, scratch / "errors").exit_code == 127);
}

TEST_CASE("limited run: a loop is ended, memory beyond the limit is refused") {
  const RunResult loop = shell("while :; do :; done", {.seconds = 1});
  CHECK(loop.timed_out);
  CHECK(loop.seconds < 5);
  // tail keeps a last line of any length in memory.
  const std::string line = "head -c 300000000 /dev/zero | tail -n 1 >/dev/null";
  CHECK(shell(line, {.memory_bytes = std::uint64_t{1} << 30}).exit_code == 0);
  CHECK(shell(line, {.memory_bytes = std::uint64_t{1} << 27}).exit_code != 0);
}

TEST_CASE("mutants: never empty, most of them different, the same for the same seed") {
  std::set<std::string> seen;
  for (std::uint64_t n = 0; n < 1000; ++n) {
    Rng rng(n), again(n);
    const std::string mutant = mutant_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", rng);
    CHECK_FALSE(mutant.empty());
    CHECK(mutant == mutant_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", again));
    seen.insert(mutant);
  }
  CHECK(seen.size() > 800);
  Rng rng(1);
  CHECK_FALSE(mutant_of("x", rng).empty());
}

TEST_CASE("info mutants: a program that ends in another way than etalon is a finding, and its mutant is kept") {
  const Scratch scratch;
  std::ofstream(scratch / "seed.obj") << "v 0 0 0\n";
  const auto run = [&](const std::string& script) {
    std::ofstream(scratch / "program") << "#!/bin/sh\n" << script << '\n';
    fs::permissions(scratch / "program", fs::perms::owner_all);
    fs::remove_all(scratch / "kept");
    return run_limited({ETALON_INFO_MUTANTS, "--program", (scratch / "program").string(), "--count", "3", "--seconds", "1", "--keep",
                        (scratch / "kept").string(), (scratch / "seed.obj").string()},
                       {.seconds = 60}, scratch / "errors")
        .exit_code;
  };
  const auto kept = [&] { return std::distance(fs::directory_iterator(scratch / "kept"), fs::directory_iterator()); };
  CHECK(run("exit 0") == 0);
  CHECK(run("echo \"etalon: error: $3: no faces\" >&2; exit 4") == 0);
  CHECK(kept() == 0);
  for (const char* script : {"exit 3", "kill -SEGV $$", "exit 4", "echo 'etalon: error: out of memory' >&2; exit 4",
                             "echo \"etalon: error: $3: internal check failed\" >&2; exit 4", "while :; do :; done"}) {
    CAPTURE(script);
    CHECK(run(script) == 2);
    CHECK(kept() == 3);
  }
}
