#include "tests/bench/bake_bench.h"

#include <doctest/doctest.h>

#include "core/bake/bake.h"
#include "core/base/error.h"
#include "core/procedural/knot.h"

using namespace etalon;
using namespace etalon::bench;

namespace {

BakeBenchResult small_result() {
  BakeBenchResult result;
  result.times = {{.title = "scan", .faces_in = 2000, .vertices_in = 1000, .bake = {1.2, 1.4, 1.3}, .simplify = {1, 1, 1}}};
  result.qualities = {
      {.title = "scan",
       .rows = {{.title = "plain", .faces = 1000, .bytes = 20000, .frame_db = 30, .both_db = 32},
                {.title = "baked, 512²", .faces = 1000, .bytes = 300000, .frame_db = 31, .both_db = 36, .outline_share = 0.5}},
       .shares = {{512, 0.25, 0.125, 0.75}}}};
  result.rivals = {{.title = "scan", .skipped = "no meshlabserver"}};
  return result;
}

}  // namespace

TEST_CASE("baking's figures: quotients and differences, met or short, and why one is skipped") {
  BakeBenchResult result = small_result();
  const std::vector<Figure> figures = bake_figures(result);
  REQUIRE(figures.size() == 8);
  CHECK(figure_json(figures[0]).at("median").get<double>() == doctest::Approx(1.3));
  CHECK(figure_json(figures[0]).at("verdict") == "met");
  CHECK(figure_json(figures[1]).at("median").get<double>() == doctest::Approx(4));
  CHECK(figure_json(figures[2]).at("why") == "no meshlabserver");
  result.times[0].bake = {1.6, 1.7, 1.8};
  result.qualities[0].rows[1].both_db = 34.5;
  CHECK(figure_json(bake_figures(result)[0]).at("verdict") == "short");
  CHECK(figure_json(bake_figures(result)[1]).at("verdict") == "short");
  result.rivals[0] = {.title = "scan",
                      .our_wall = {1.0},
                      .our_cpu = {2.0},
                      .meshlab_wall = {3.0},
                      .meshlab_cpu = {3.0},
                      .sampled_wall = {1.5},
                      .sampled_cpu = {2.5},
                      .rows = {{.title = "a", .both_db = 30},
                               {.title = "b", .both_db = 28},
                               {.title = "c", .both_db = 29},
                               {.title = "d", .both_db = 32.5},
                               {.title = "e", .both_db = 33.5}}};
  const std::vector<Figure> with_rival = bake_figures(result);
  CHECK(with_rival[2].values == std::vector<double>{3});
  CHECK(with_rival[3].values == std::vector<double>{1.5});
  CHECK(with_rival[4].values == std::vector<double>{1});
  CHECK(with_rival[5].values == std::vector<double>{2});
  CHECK(with_rival[6].values == std::vector<double>{4.5});
  CHECK(with_rival[7].values == std::vector<double>{4.5});
  CHECK(bake_tables(bake_document(result)).find("| the same with `--fill sampled --gutter 0` | 1.50 | 2.50 |") != std::string::npos);
}

TEST_CASE("baking's tables and picture come from the document; what was not measured is left out") {
  BakeBenchResult result = small_result();
  const nlohmann::ordered_json document = bake_document(result);
  const std::string tables = bake_tables(document);
  CHECK(tables.find("| scan | 2,000 | 512² | 1.000 | 1.300 | 0.300 | 300000 |") != std::string::npos);
  CHECK(tables.find("| baked, 512² | 1,000 | 300,000 | 31.00 | 50.0 % | **36.00** |") != std::string::npos);
  CHECK(tables.find("Texels of the 512² map: 25.0 % hit (12.5 % averaged), 75.0 % filled.") != std::string::npos);
  CHECK(tables.find("skipped: no meshlabserver") != std::string::npos);
  CHECK(tables.find("How time grows") == std::string::npos);
  CHECK(bake_growth_picture(document).empty());
  for (const int k : {1, 10}) {
    result.growth_faces.push_back(result.times[0]);
    result.growth_faces.back().faces_in = 20000u * static_cast<unsigned>(k);
    result.growth_maps.push_back(result.times[0]);
    result.growth_maps.back().map = 256 * k;
  }
  CHECK(bake_growth_picture(bake_document(result)).find("</svg>") != std::string::npos);
  CHECK(bake_tables(bake_document(result)).find("How time grows with the map") != std::string::npos);
}

TEST_CASE("the baking's block of the page is replaced, and a page without one is refused") {
  const std::string page = std::string("a\n") + kBakeBlockBegin + "old\n" + kBakeBlockEnd + "b\n";
  const std::string changed = with_bake_tables(page, "new\n");
  CHECK(changed == std::string("a\n") + kBakeBlockBegin + "\nnew\n\n" + kBakeBlockEnd + "b\n");
  CHECK_THROWS_AS((void)with_bake_tables("a\n", "new\n"), InputError);
}

TEST_CASE("views: the dense model against itself has no error; a smooth one baked is nearer than grey") {
  Mesh scan = procedural::make_knot({.rings = 60, .around = 20});
  const BoundingBox box = bounding_box(scan);
  for (std::size_t v = 0; v < scan.vertex_count(); ++v)
    for (int c = 0; c < 3; ++c) scan.colors[v][c] = (scan.positions[v][c] - box.lo[c]) / (box.hi[c] - box.lo[c]);
  const DenseViews dense(scan);
  const ViewQuality same = dense.compare("itself", scan, nullptr);
  CHECK(same.frame_db == 0);  // no error: no decibels
  CHECK(same.outline_share == 0);
  const bake::BakeResult baked = bake::bake_scan(scan, {.target_faces = 600, .width = 256, .height = 256});
  const auto texture = std::make_shared<const Image>(baked.texture);
  const ViewQuality good = dense.compare("baked", baked.mesh, texture);
  Mesh grey = baked.simplified.mesh;
  grey.colors.assign(grey.vertex_count(), {0.5f, 0.5f, 0.5f, 1});
  const ViewQuality bad = dense.compare("grey", grey, nullptr);
  CHECK(good.both_db > bad.both_db + 3);
  CHECK(good.outline_share > 0);
  CHECK(good.outline_share < 1);
}

TEST_CASE("time on top: the median over the rounds, never below 0") {
  CHECK(BakeTime{.bake = {3, 5, 4}, .simplify = {1, 1, 1}}.own_seconds() == 3);
  CHECK(BakeTime{.bake = {1}, .simplify = {2}}.own_seconds() == 0);
}
