#include <algorithm>
#include <filesystem>

#include <doctest/doctest.h>

#include "tests/cli/run_command.h"

using namespace etalon::test;

TEST_CASE("Ctrl-C while drawing or writing: 130, nothing half-written") {
  for (const int delay_ms : {20, 60, 150, 400}) {
    CAPTURE(delay_ms);
    const ScratchFolder folder;
    folder.file("square.obj", square_obj());
    const CommandResult result =
        run_etalon({"verify", "square.obj", "--size", "2048", "--report", "report", "--json", "verify.json", "--quiet"},
                   {.folder = folder.path(), .interrupt_after_ms = delay_ms});
    CHECK(result.exit_code == 130);
    // Only whole files under their own names may be there: each file of the report or none of it, no temporary one.
    for (const std::string& name : folder.listing()) {
      CAPTURE(name);
      const std::vector<std::string> known{"square.obj",         "report",     "report/index.html", "report/verify.json",
                                           "report/classes.csv", "verify.json"};
      CHECK(std::find(known.begin(), known.end(), name) != known.end());
    }
    const bool page = std::filesystem::exists(folder.path() / "report/index.html");
    CHECK(page == std::filesystem::exists(folder.path() / "report/verify.json"));
  }
}
