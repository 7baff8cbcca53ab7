#include "tests/bench/simplify_bench.h"

#include <doctest/doctest.h>

#include <fstream>

#include "core/base/error.h"
#include "core/procedural/knot.h"
#include "tests/bench/child.h"
#include "tests/bench/simplify_document.h"
#include "tests/bench/simplify_figures.h"

using namespace etalon;
using namespace etalon::bench;

namespace {

WayResult measured(const std::string& name, std::vector<double> seconds, double peak, double rms) {
  return {.name = name,
          .title = name,
          .skipped = "",
          .seconds = std::move(seconds),
          .peak_bytes = {peak},
          .faces = 10,
          .rms = rms,
          .mean = rms / 2,
          .colour_rms = 0.05};
}

}  // namespace

TEST_CASE("figures: quotients round by round; memory and distance once; a rival that is absent is skipped with its reason") {
  SimplifySceneResult result{.name = "s", .title = "S", .faces_in = 2'000'000, .target_faces = 10};
  result.ways = {measured("ours-qem", {1, 2, 1}, 100, 0.01), measured("cgal-gh", {7, 12, 8}, 80, 0.02)};
  result.ways.push_back({.name = "openmesh", .title = "OpenMesh", .skipped = "built without libopenmesh-dev"});
  const std::vector<Figure> figures = figures_of(result);
  REQUIRE(figures.size() == 4);
  CHECK(figures[0].title == "time: CGAL ÷ ours");
  CHECK(figures[0].values == std::vector<double>{7, 6, 8});
  CHECK(figures[0].goal == 6);
  CHECK(figures[1].values.empty());
  CHECK(figures[1].skipped == "built without libopenmesh-dev");
  CHECK(figures[2].title == "peak memory: ours ÷ CGAL");
  CHECK(figures[2].values == std::vector<double>{1.25});
  CHECK(figures[3].skipped != "");
}

TEST_CASE("published rows: better in both, and in one only") {
  CHECK(rows_better_in_both(0.0005, 0.02) == 0);  // better in form than all
  CHECK(rows_better_in_both(0.002, 0.02) == 0);   // better in colour than all
  CHECK(rows_better_in_both(0.002, 0.1) == published_colour_rows().size());
  CHECK(rows_better_in_both(0.00074, 0.04) == 1);  // 0.0736 % and 0.0380
}

TEST_CASE("Metro's figures: in % of its own diagonal, the worse of mean and RMS") {
  SimplifySceneResult result{.name = kPublishedScene, .title = "S", .faces_in = 1000, .target_faces = 10, .metro_diagonal = 1.25};
  result.ways = {measured("cgal-gh", {1}, 1, 0.000562 * 1.25 * 1.005)};
  result.ways[0].mean = 0.000436 * 1.25 * 0.98;
  const std::vector<Figure> figures = figures_of(result);
  REQUIRE(figures.size() == 1);
  CHECK(figures[0].values[0] == doctest::Approx(0.02));
}

TEST_CASE("tables and picture of what was measured; ways that were not run say so") {
  std::vector<SimplifySceneResult> results;
  for (const std::size_t faces : {10'000u, 100'000u}) {
    results.push_back(
        {.name = "simplify-growth-" + std::to_string(faces), .title = "growth", .faces_in = faces, .target_faces = faces / 10});
    results.back().ways = {measured("ours-qem", {static_cast<double>(faces) * 1e-6}, 1e7, 0.001)};
  }
  SimplifySceneResult scene{.name = "simplify-x", .title = "x", .faces_in = 1000, .target_faces = 100};
  scene.ways = {measured("ours-qem", {0.25}, 5e6, 0.001), {.name = "meshopt", .title = "meshoptimizer", .skipped = "built without it"}};
  results.push_back(scene);
  const auto document = simplify_document(results);
  const std::string tables = simplify_tables(document);
  CHECK(tables.find("| ours-qem | 10 | 0.250 | 5 | 0.1000 | 0.0500 | 0.0500 |") != std::string::npos);
  CHECK(tables.find("| meshoptimizer | skipped: built without it |") != std::string::npos);
  CHECK(tables.find("| 100,000 | 0.100 | 60.2 |") != std::string::npos);  // 10^8 ns ÷ (10^5 · log2 10^5)
  const std::string picture = growth_picture(document);
  CHECK(picture.starts_with("<svg "));
  CHECK(picture.ends_with("</svg>\n"));
  CHECK(growth_picture(simplify_document({scene})).empty());
}

TEST_CASE("a mesh goes through a raw file unchanged; a cut one is refused") {
  const ScratchDirectory scratch;
  const Mesh knot = procedural::make_knot({.rings = 12, .around = 4});
  write_raw_mesh(scratch / "knot", knot);
  CHECK(read_raw_mesh(scratch / "knot") == knot);
  std::filesystem::resize_file(scratch / "knot", std::filesystem::file_size(scratch / "knot") - 1);
  CHECK_THROWS_AS((void)read_raw_mesh(scratch / "knot"), InputError);
  CHECK_THROWS_AS((void)read_raw_mesh(scratch / "nothing"), InputError);
}

TEST_CASE("programs: their output, exit code and time; one that is not there") {
  const ScratchDirectory scratch;
  const ChildCost hello = run_program({"sh", "-c", "echo hello; echo problem >&2; exit 3"}, scratch / "log");
  CHECK(hello.exit_code == 3);
  CHECK(hello.output == "hello\n");
  std::ifstream log(scratch / "log");
  std::string line;
  std::getline(log, line);
  CHECK(line == "problem");
  CHECK(run_program({"etalon-no-such-program"}, scratch / "log").exit_code == -1);
}

TEST_CASE("ways: ours can be run; names are told apart; a child's arguments are checked") {
  const Mesh knot = procedural::make_knot({.rings = 40, .around = 8});
  for (const SimplifyWay& way : simplify_ways()) {
    CAPTURE(way.name);
    CHECK(&simplify_way(way.name) == &way);
    if (!way.run) {
      CHECK(way.absent != "");
      continue;
    }
    const SimplifyOutcome outcome = way.run(knot, 300);
    CHECK(outcome.mesh.face_count() <= 300);
    CHECK(outcome.mesh.face_count() > 280);
    CHECK(outcome.seconds >= 0);
  }
  CHECK_THROWS_AS((void)simplify_way("nothing"), InputError);
  CHECK_THROWS_AS((void)simplify_child({"ours-qem"}), InputError);
  for (const SimplifyScene& scene : simplify_scenes())
    for (const std::string& way : scene.ways) CHECK(simplify_way(way).name == way);
}
