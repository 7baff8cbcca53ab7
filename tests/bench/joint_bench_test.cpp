#include "tests/bench/joint_bench.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/procedural/alps.h"

using namespace etalon;
using namespace etalon::bench;

namespace {

JointTerrain small_alps() {
  procedural::Alps alps = procedural::make_alps({.size = 33, .texture_size = 64, .progress = {}});
  terrain::DemOptions how;
  how.dem_spacing = alps.spacing;
  return {terrain::make_height_field(alps.dem, how).field, std::move(alps.texture)};
}

/// Draws nothing, and says which pairs it was asked for.
class BlackRival : public PairRival {
 public:
  explicit BlackRival(std::vector<joint::Pair>& asked) : asked_(asked) {}
  void draw_and_read_back(joint::Pair pair, Image& picture) override {
    asked_.push_back(pair);
    std::ranges::fill(picture.bytes(), std::byte{0});
  }

 private:
  std::vector<joint::Pair>& asked_;
};

const joint::LevelOptions kLevels{.meshes = 4, .textures = 5, .from = 0.01, .to = 0.3};

}  // namespace

TEST_CASE("joint: each seventh pair of a rival that draws nothing, which is seen; ours has the bytes of full renderings") {
  std::vector<joint::Pair> asked;
  const JointScene scene{.name = "joint-small", .title = "small", .make = {}};
  const MakePairRival make = [&](const validation::TerrainProblem&) { return std::make_unique<BlackRival>(asked); };
  JointScenes scenes;
  scenes.joint.push_back(measure_joint(scene, small_alps(), make, 2, kLevels, 64, 48));
  const JointBenchResult& result = scenes.joint[0];
  CHECK(result.pairs() == 20);
  CHECK(result.rival_pairs == 3);
  REQUIRE(asked.size() == 8);  // two rounds of three pairs, and of the finest
  CHECK(asked[1] == joint::Pair{1, 2});
  CHECK(asked[3] == joint::Pair{3, 4});
  CHECK(result.differing > 0.2);
  CHECK(result.compared == 1);
  CHECK(result.equal == 1);
  CHECK(result.marginal.size() == 2);
  CHECK(result.evaluations <= 2 * 9);
  CHECK(joint_figures(scenes)[4].values[0] == 0);
  const std::string tables = joint_tables(joint_document(scenes));
  CHECK(tables.find("| small | 20 |") != std::string::npos);
  CHECK(tables.find("| 1 of 1 |") != std::string::npos);
}

TEST_CASE("joint: without a device the figures say so; a picture that differs is counted") {
  JointScenes scenes;
  scenes.joint.push_back(measure_joint({.name = "n", .title = "t", .make = {}}, small_alps(), {}, 1, kLevels, 64, 48));
  scenes.joint[0].equal = 0;
  CHECK(joint_figures(scenes)[2].values.empty());
  const std::string tables = joint_tables(joint_document(scenes));
  CHECK(tables.find("skipped: no device") != std::string::npos);
  CHECK(tables.find("t: pairs that differ from full renderings | **1.000** | ≤ 0 | short |") != std::string::npos);
}

TEST_CASE("quadtrees: the ratio to rounds of n log n, memory against its goal, and the picture") {
  JointScenes scenes;
  scenes.quadtrees = {{.side = 257, .order_seconds = 0.1, .peak_bytes = 1e8}};
  CHECK(quadtree_picture(joint_document(scenes)).empty());
  scenes.quadtrees.push_back({.side = 4097, .order_seconds = 50, .peak_bytes = 5.0 * 1024 * 1024 * 1024});
  const nlohmann::ordered_json document = joint_document(scenes);
  const std::string tables = joint_tables(document), picture = quadtree_picture(document);
  CHECK(tables.find("| 4097² | 16,785,409 | 50.000 | 124.1 |") != std::string::npos);  // 50e9 / (16785409·24.0007)
  CHECK(tables.find("peak, GiB | **5.000** | ≤ 4 | short |") != std::string::npos);
  CHECK(picture.find("4097²") != std::string::npos);
  CHECK(picture.find("</svg>") != std::string::npos);
  CHECK_THROWS_AS((void)measure_quadtree("/does/not/exist", 257), UnavailableError);
  CHECK_THROWS_AS(quadtree_child({}), InputError);
}
