// Which texels continuity makes equal.
#include <doctest/doctest.h>

#include "core/base/rng.h"
#include "tests/bake/fill_fixture.h"

using namespace etalon;
using namespace etalon::bake;
using namespace etalon::test;

TEST_CASE("figure 2: sizes 4 and 2 on one edge: b1 = a1 = a2 and b2 = a3 = a4") {
  // The edge runs from vertex 0 to 1: along i, from corner 0 to 1, in the first triangle; from corner 1 to 0 in the second. The third makes the
  // class of 4 even.
  const Mesh mesh =
      mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{0, 1, 2}, {1, 0, 3}, {4, 5, 6}});
  const FillCase c(mesh, {4, 2, 4}, {0});
  const auto a = [&](int i) { return c.nodes.node_of(c.nodes.texel(0, 4, i, 0)); };
  const std::uint32_t b1 = c.nodes.node_of(c.nodes.texel(1, 2, 1, 0)), b2 = c.nodes.node_of(c.nodes.texel(1, 2, 0, 0));
  CHECK(a(0) == a(1));
  CHECK(a(0) == b1);
  CHECK(a(2) == a(3));
  CHECK(a(2) == b2);
  CHECK(b1 != b2);
  // Nothing else is equal.
  CHECK(c.nodes.group_count() == 2);
  CHECK(c.nodes.members(0).size() == 3);
  CHECK(c.nodes.members(1).size() == 3);
}

TEST_CASE("groups are those of overlapping pieces of edges and of common vertices") {
  Rng rng(5);
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Mesh mesh = seed % 3 == 0 ? fins() : relief(2, seed);
    std::vector<double> ratios(mesh.face_count());
    for (double& ratio : ratios) ratio = static_cast<double>(2u << rng.below(4));
    const FillCase c(std::move(mesh), ratios, seed, 4);
    const std::vector<std::uint32_t> node = judge_nodes(c);
    for (std::uint32_t t = 0; t < node.size(); ++t) REQUIRE(c.nodes.node_of(t) == node[t]);
    std::vector<std::uint32_t> counts(node.size());
    for (const std::uint32_t n : node) ++counts[n];
    for (std::uint32_t t = 0; t < node.size(); ++t) {
      const std::uint32_t g = c.nodes.group_of(t);
      REQUIRE((g == kNoGroup) == (counts[node[t]] == 1));
      if (g != kNoGroup) REQUIRE(c.nodes.members(g).size() == counts[node[t]]);
    }
  }
}
