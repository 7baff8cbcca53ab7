#include "tests/bench/metro_bench.h"

#include <doctest/doctest.h>

using namespace etalon::bench;

TEST_CASE("MeshLab's log: samples, mean and RMS in model units, direction by direction") {
  const std::vector<MeshlabAnswer> answers = meshlab_answers(
      "Hausdorff Distance computed\n     Sampled 2049998 pts (rng: 0) on a.ply searched closest on b.ply\n"
      "     min : 0.000000   max 0.049137   mean : 0.005270   RMS : 0.006982\n"
      "Values w.r.t. BBox Diag (9.634952)\n     min : 0.000000   max 0.005100   mean : 0.000547   RMS : 0.000725\n"
      "     Sampled 2005002 pts (rng: 0) on b.ply searched closest on a.ply\n"
      "     min : 0.000000   max 0.049   mean : 0.005   RMS : 0.006\n");
  REQUIRE(answers.size() == 2);
  CHECK(answers[0].samples == 2049998);
  CHECK(answers[0].mean == 0.005270);
  CHECK(answers[0].rms == 0.006982);
  CHECK(answers[1].samples == 2005002);
  CHECK(answers[1].rms == 0.006);
  CHECK(meshlab_answers("cannot open display").empty());
}

TEST_CASE("without MeshLab: ours alone, and the figures say why they are skipped") {
  MetroBenchResult result{.skipped = "no meshlabserver", .faces_a = 1000, .faces_b = 100};
  result.ours.seconds = {0.5};
  result.ours.samples = {10, 20};
  result.figures = {{.title = "time: MeshLab ÷ ours", .goal = 3, .sense = Sense::at_least, .skipped = result.skipped}};
  const std::string tables = metro_tables(metro_document(result));
  CHECK(tables.find("| ours | 10 + 20 | 0.500 (0.500–0.500) |") != std::string::npos);
  CHECK(tables.find("skipped: no meshlabserver") != std::string::npos);
  CHECK(tables.find("Hausdorff filter") == std::string::npos);
}
