#include "tests/bench/bench_document.h"

#include <algorithm>
#include <sstream>
#include <string>

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "tests/bench/bench_options.h"

using namespace etalon;
using namespace etalon::bench;

namespace {

SceneResult sample_result() {
  SceneResult result;
  result.name = "scene";
  result.title = "a scene";
  result.work = {.vertices = 3, .triangles = 1, .covered_texels = 1234, .lookups = 1234, .lookup_bytes = 4};
  result.counters = {.values = 1000, .scalar = 10, .exact_path = 1};
  result.ways = {{kRivalDraw, {}, {6, 9, 20}}, {kRivalReadBack, {}, {8, 12, 21}}, {kOurs, {}, {2, 3, 10}},
                 {kValidation, {}, {1, 1, 1}}, {kCopy, {}, {0.5, 0.25, 0.5}},     {kGather, {}, {1, 1.5, 2}}};
  result.others = {0.02, 0, 0.5};
  result.rivals = {{kRivalDraw, 2, 0.001}, {kRivalReadBack, 0, 0.001}};
  return result;
}

BenchRun sample_run() {
  return {.machine = {"2026-11-22", "a processor", 2, "a system", "a compiler", 0.5},
          .threads = 2,
          .rival_threads = 3,
          .rival = "a device",
          .level = "avx2"};
}

}  // namespace

TEST_CASE("bench document: medians of times, ratios of rounds, the larger limit") {
  const auto document = bench_document(sample_run(), {sample_result(), SceneResult{.name = "not measured"}});
  REQUIRE(document.at("scenes").size() == 1);
  const auto& scene = document.at("scenes")[0];
  CHECK(scene.at("rounds") == 3);
  CHECK(scene.at("times_ms").at("ours").at("median") == 3);
  CHECK(scene.at("limit_ms") == 1.5);
  CHECK(scene.at("others") == 0.02);
  REQUIRE(scene.at("ratios").size() == 2);
  CHECK(scene.at("ratios")[0].at("median") == 3);  // of 6/2, 9/3, 20/10
  CHECK(scene.at("ratios")[0].at("lower") == 2);
  CHECK(scene.at("ratios")[0].at("goal") == 2);
}

TEST_CASE("bench document: the tables say it") {
  const std::string tables = bench_tables(bench_document(sample_run(), {sample_result()}));
  CHECK(tables.find("Measured on 2026-11-22: a processor, 2 cores, a system, a compiler; load 0.5 at the start. Rival: a device, 3 "
                    "threads. Ours: 2 threads, level avx2.") != std::string::npos);
  CHECK(tables.find("| a scene | 3.00 | 9.00 | 12.0 | **3.00** (2.00–3.00) | ≥ 2 | 1.50 | 2.0 | 1 ‰ |") != std::string::npos);
  CHECK(tables.find("| a scene | 1 | 1,234 | 1.00 | 3.00 | 0.50 | 1.50 |  | 0.01 | 0.001 | 3 | 2 % |") != std::string::npos);
}

TEST_CASE("bench document: every row has as many cells as its table's head") {
  SceneResult without_texture = sample_result();
  without_texture.ways.pop_back();
  without_texture.rivals.clear();
  SceneResult other_level = sample_result();
  other_level.ways.push_back({"ours, avx512", {}, {1, 1, 1}});
  std::istringstream lines(bench_tables(bench_document(sample_run(), {without_texture, other_level})));
  std::ptrdiff_t cells = 0;
  int rows = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::ptrdiff_t bars = std::ranges::count(line, '|');
    if (bars == 0) {
      cells = 0;
      continue;
    }
    if (cells == 0) cells = bars;
    CHECK_MESSAGE(bars == cells, line);
    ++rows;
  }
  CHECK(rows == 4 + 4);
}

TEST_CASE("bench document: without a rival a scene has its times and limits") {
  SceneResult result = sample_result();
  result.rivals.clear();
  BenchRun run = sample_run();
  run.rival.clear();
  const std::string tables = bench_tables(bench_document(run, {result}));
  CHECK(tables.find("Rival: none, ") != std::string::npos);
  CHECK(tables.find("| a scene | 3.00 | | | | | 1.50 | 2.0 | |") != std::string::npos);
}

TEST_CASE("bench document: another document is refused") {
  CHECK_THROWS_WITH_AS((void)bench_tables({{"schema", "etalon/verify/1"}}), "expected a document etalon/bench/1", InputError);
  CHECK_THROWS_AS((void)bench_tables(nlohmann::ordered_json::parse("{]", nullptr, false)), InputError);
  CHECK_THROWS_AS((void)bench_tables({{"schema", "etalon/bench/1"}}), InputError);
}

TEST_CASE("bench page: only the measured block changes, and there must be one") {
  const std::string begin = kBlockBegin, end = kBlockEnd;
  CHECK(with_tables("before\n" + begin + "old\n" + end + "after\n", "new\n") == "before\n" + begin + "\nnew\n\n" + end + "after\n");
  for (const std::string& page : {std::string("none\n"), begin, end + begin, begin + begin + end, begin + end + end}) {
    CAPTURE(page);
    CHECK_THROWS_AS((void)with_tables(page, "new\n"), InputError);
  }
}

TEST_CASE("bench document: rounds that others disturbed are dropped, while enough are left") {
  SceneResult result = sample_result();
  CHECK(result.keep_quiet_rounds(0.05, 3) == 3);
  CHECK(result.keep_quiet_rounds(0.05, 2) == 2);
  CHECK(result.times_of(kOurs) == std::vector<double>{2, 3});
  CHECK(result.times_of(kRivalDraw) == std::vector<double>{6, 9});
  CHECK(result.others == std::vector<double>{0.02, 0});
}

TEST_CASE("machine: it has a name, and shares are shares") {
  const Machine machine = this_machine();
  CHECK(machine.cores >= 1);
  CHECK(machine.date.size() == 10);
  OtherPrograms others;
  for (int i = 0; i < 3; ++i) {
    const double share = others.share();
    CHECK((share >= 0 && share <= 1));
  }
}

TEST_CASE("bench options") {
  const BenchOptions options = parse_options({"--scene", "head", "--scene", "fans", "--repetitions", "25", "--json", "r.json"});
  CHECK(options.repetitions == 25);
  CHECK(options.json == "r.json");
  CHECK(wants(options, "real_head_linear"));
  CHECK_FALSE(wants(options, "terrain"));
  CHECK(wants({}, "terrain"));
  CHECK(options.rival_threads == -1);
  CHECK(parse_options({"--rival-threads", "0"}).rival_threads == 0);
  CHECK(parse_options({"-h"}).help);
  CHECK(usage().find("etalon_bench --scene head") != std::string::npos);
  CHECK_THROWS_WITH_AS((void)parse_options({"--threads", "0"}), "--threads: expected 1 to 32, got '0'", InputError);
  CHECK_THROWS_WITH_AS((void)parse_options({"--repetitions", "5x"}), "--repetitions: expected 5 to 10000, got '5x'", InputError);
  CHECK_THROWS_WITH_AS((void)parse_options({"--json"}), "--json: expected a value after it", InputError);
  CHECK_THROWS_WITH_AS((void)parse_options({"--fast"}), "--fast: expected an option of etalon_bench --help", InputError);
}
