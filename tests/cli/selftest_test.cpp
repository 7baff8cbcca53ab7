#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "cli/selftest_command.h"
#include "raster/simd_level.h"
#include "tests/cli/run_command.h"
#include "tests/cli/schema_validator.h"
#include "validation/selftest/scene_hash.h"

using namespace etalon;
using namespace etalon::test;
using nlohmann::json;

namespace {

json checked_document(const std::string& text) {
  json document = json::parse(text);
  const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/selftest.json"));
  for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
  return document;
}

std::string best_level() { return raster::to_string(raster::available_simd_levels().back()); }

std::string level_from_elsewhere() { return best_level() == "neon" ? "avx2" : "neon"; }

}  // namespace

TEST_CASE("selftest --help: an example") {
  const CommandResult help = run_etalon({"selftest", "--help"});
  CHECK(help.exit_code == 0);
  CHECK(help.out.find("Example:\n  etalon selftest") != std::string::npos);
  CHECK(run_etalon({"--help"}).out.find("selftest") != std::string::npos);
}

TEST_CASE("selftest --small: every level, the one hash, a verdict; nothing is written") {
  const ScratchFolder folder;
  const CommandResult result = run_etalon({"selftest", "--small"}, {.folder = folder.path()});
  CAPTURE(result.out);
  CHECK(result.exit_code == 0);
  CHECK(result.err.empty());
  for (const raster::SimdLevel level : raster::available_simd_levels())
    CHECK(result.out.find("vectorised  " + raster::to_string(level)) != std::string::npos);
  CHECK(result.out.find("expected    " + validation::golden_scene_hashes().all + "\n") != std::string::npos);
  CHECK(result.out.find("\nOpenGL      ") != std::string::npos);
  CHECK(result.out.find("DIFF") == std::string::npos);
  CHECK(result.out.find("selftest passed") != std::string::npos);
  CHECK(folder.listing().empty());
}

TEST_CASE("selftest: one level, one thread count, as a document; only `run` may differ between runs") {
  const CommandResult one = run_etalon({"selftest", "--small", "--simd", best_level(), "--threads", "1", "--json", "-", "--quiet"});
  const CommandResult two = run_etalon({"selftest", "--small", "--simd", "baseline", "--threads", "3", "--json", "-", "--quiet"});
  CHECK(one.exit_code == 0);
  CHECK(one.err.empty());
  json document = checked_document(one.out), other = checked_document(two.out);
  CHECK(document["passed"] == true);
  CHECK(document["golden"] == validation::golden_scene_hashes().all);
  REQUIRE(document["run"]["hashes"].size() == 1);
  CHECK(document["run"]["hashes"][0]["simd"] == best_level());
  CHECK(document["run"]["hashes"][0]["threads"] == 1);
  CHECK(document["run"]["hashes"][0]["sha256"] == document["golden"]);
  CHECK(other["run"]["hashes"][0]["threads"] == 3);
  CHECK(document["run"]["judge"][0]["simd"].is_null());
  document.erase("run"), other.erase("run");
  CHECK(document == other);
}

TEST_CASE("selftest --seed: other scenes for the judge") {
  const auto texels = [](const std::string& seed) {
    const CommandResult result =
        run_etalon({"selftest", "--small", "--simd", best_level(), "--threads", "2", "--seed", seed, "--json", "-", "--quiet"});
    CHECK(result.exit_code == 0);
    return checked_document(result.out)["run"]["judge"][0]["texels"].get<int>();
  };
  CHECK(texels("1") != texels("2"));
}

TEST_CASE("selftest: refusals") {
  const CommandResult unknown = run_etalon({"selftest", "--simd", "mmx"});
  CHECK(unknown.exit_code == 64);
  CHECK(unknown.err.find("--simd: expected all or one of ") != std::string::npos);
  CHECK(unknown.err.find("got 'mmx'") != std::string::npos);
  const CommandResult elsewhere = run_etalon({"selftest", "--simd", level_from_elsewhere()});
  CHECK(elsewhere.exit_code == 1);
  CHECK(elsewhere.err.find("not available on this machine, which has ") != std::string::npos);
  CHECK(run_etalon({"selftest", "--simd", ""}).exit_code == 64);
  CHECK(run_etalon({"selftest", "--seed", "-1"}).exit_code == 64);
  CHECK(run_etalon({"selftest", "--json", "/nonexistent/folder/x.json"}).exit_code == 4);
  CHECK(run_etalon({"selftest", "stray"}).exit_code == 64);
}

TEST_CASE("selftest --quiet: what failed first, in one line") {
  using namespace etalon::validation;
  SelftestResult result;
  result.golden.all = "aa";
  result.hashes = {{.drawing = {raster::Evaluation::vectorised, raster::SimdLevel::baseline, 7}, .sha256 = "aa", .difference = {}}};
  result.judged = {{.drawing = {raster::Evaluation::filtered, {}, 1}, .first_mismatch = {}}};
  result.arithmetic = {{"sums are not re-associated", "0", "0"}};
  CHECK(result.passed());
  CHECK(cli::first_failure(result).empty());
  result.judged[0].mismatches = 2;
  result.judged[0].first_mismatch = "judged 3: texel (1, 2)";
  CHECK(cli::first_failure(result) == "selftest: filtered -: 2 values other than the judge's, the first judged 3: texel (1, 2)");
  result.hashes[0].sha256 = "bb";
  result.hashes[0].difference = "family ties";
  CHECK(cli::first_failure(result) == "selftest: vectorised baseline, 7 threads: expected aa, got bb: family ties");
  result.arithmetic[0].got = "1";
  CHECK(cli::first_failure(result) == "selftest: sums are not re-associated: expected 0, got 1");
  CHECK_FALSE(result.passed());
}
