#include <doctest/doctest.h>

#include "tests/cli/run_command.h"

using namespace etalon::test;

TEST_CASE("--help: exit 0, on standard output, with an example for each verb") {
  const CommandResult root = run_etalon({"--help"});
  CHECK(root.exit_code == 0);
  CHECK(root.err.empty());
  for (const std::string verb :
       {"verify", "render", "info", "make", "simplify", "progressive", "adapt", "bake", "joint", "metro", "diff", "probe", "study"}) {
    CAPTURE(verb);
    CHECK(root.out.find(verb) != std::string::npos);
    const CommandResult help = run_etalon({verb, "--help"});
    CHECK(help.exit_code == 0);
    CHECK(help.err.empty());
    CHECK(help.out.find("Example:\n  etalon " + verb) != std::string::npos);
    CHECK(help.out.find("--json") != std::string::npos);
  }
}

TEST_CASE("--version, before and after the verb") {
  const CommandResult root = run_etalon({"--version"});
  CHECK(root.exit_code == 0);
  CHECK(root.out.rfind("etalon 0.", 0) == 0);
  CHECK(run_etalon({"verify", "--version"}).out == root.out);
}

TEST_CASE("help or a version that cannot be written is an error") {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help"}, {"--version"}, {"verify", "--help"}, {"verify", "--version"}}) {
    CAPTURE(arguments.back());
    const CommandResult full = run_etalon(arguments, {.stdout_path = "/dev/full"});
    CHECK(full.exit_code == 4);
    CHECK(full.error_lines().size() == 1);
  }
}
