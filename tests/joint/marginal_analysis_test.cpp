#include "core/joint/marginal_analysis.h"

#include <doctest/doctest.h>

#include <set>

#include "core/base/error.h"
#include "core/joint/exhaustive_search.h"
#include "tests/joint/problems.h"

using namespace etalon;
using namespace etalon::joint;
using namespace etalon::test;

namespace {

std::vector<Pair> pairs_of(const Path& path) {
  std::vector<Pair> pairs;
  for (const PathPoint& p : path.points) pairs.push_back(p.pair);
  return pairs;
}

const std::vector<StepRule> kRules = {StepRule::slope, StepRule::printed, StepRule::budget};
const std::vector<Direction> kDirections = {Direction::prune, Direction::grow};

// Two meshes and two textures: the mesh's step removes 100 bits for 30, the texture's 10 bits for 20.
Problem unequal_steps() { return separable_problem({50, 150}, {30, 0}, {5, 15}, {20, 0}); }

}  // namespace

TEST_CASE("slope prunes what costs least error per bit, the printed loop what costs least error") {
  // 30/100 < 20/10, but 20 < 30.
  CHECK(pairs_of(marginal_analysis(unequal_steps())) == std::vector<Pair>{{0, 0}, {0, 1}, {1, 1}});
  CHECK(pairs_of(marginal_analysis(unequal_steps(), {.rule = StepRule::printed})) == std::vector<Pair>{{0, 0}, {1, 0}, {1, 1}});
}

TEST_CASE("slope grows by the greatest fall per bit, the printed loop to the least error") {
  CHECK(pairs_of(marginal_analysis(unequal_steps(), {.direction = Direction::grow})) == std::vector<Pair>{{0, 0}, {0, 1}, {1, 1}});
  CHECK(pairs_of(marginal_analysis(unequal_steps(), {.rule = StepRule::printed, .direction = Direction::grow})) ==
        std::vector<Pair>{{0, 0}, {1, 0}, {1, 1}});
}

TEST_CASE("ties are the mesh's") {
  const Problem problem = separable_problem({10, 20}, {7, 0}, {10, 20}, {7, 0});
  for (const StepRule rule : kRules) {
    CHECK(marginal_analysis(problem, {.rule = rule, .budget_bits = 10}).points[1].pair == Pair{0, 1});
    CHECK(marginal_analysis(problem, {.rule = rule, .direction = Direction::grow, .budget_bits = 10}).points[1].pair == Pair{1, 0});
  }
}

TEST_CASE("a step that does not raise the error goes first, however few bits it removes") {
  // The texture's step lowers the error by 1 for 1 bit; the mesh's raises it by 1 for a million.
  const Problem falls = separable_problem({1, 1'000'001}, {1, 0}, {1, 2}, {0, 1});
  CHECK(marginal_analysis(falls).points[1].pair == Pair{1, 0});
  const Problem flat = separable_problem({1, 1'000'001}, {1, 0}, {1, 2}, {0, 0});
  CHECK(marginal_analysis(flat).points[1].pair == Pair{1, 0});
}

TEST_CASE("products of errors and bits beyond 64 bits are compared exactly") {
  // Slopes 2^61/2^61 and (2^61 - 1)/2^61: equal in double.
  const std::uint64_t big = std::uint64_t{1} << 61;
  CHECK(marginal_analysis(separable_problem({0, big}, {big, 0}, {0, big}, {big - 1, 0})).points[1].pair == Pair{1, 0});
  CHECK(marginal_analysis(separable_problem({0, big}, {big - 1, 0}, {0, big}, {big, 0})).points[1].pair == Pair{0, 1});
}

TEST_CASE("levels of equal bits are passed over, the finest of them stays") {
  std::set<std::size_t> meshes;
  Problem problem = separable_problem({10, 10, 20, 20, 20}, {9, 8, 3, 2, 1}, {5, 9, 9}, {4, 2, 1});
  const auto inner = problem.error;
  problem.error = [&](std::size_t i, std::size_t j) {
    meshes.insert(i);
    return inner(i, j);
  };
  const Path path = marginal_analysis(problem);
  CHECK(meshes == std::set<std::size_t>{1, 4});
  CHECK(path.points.front().pair == Pair{1, 0});
  CHECK(path.points.back().pair == Pair{4, 2});
  CHECK(path.points.size() == 3);
  for (std::size_t n = 1; n < path.points.size(); ++n) CHECK(path.points[n].bits > path.points[n - 1].bits);
}

TEST_CASE("paths go from the smallest to the largest pair by single levels, each pair is asked for once") {
  Rng rng(3);
  for (int round = 0; round < 50; ++round) {
    const std::size_t meshes = 1 + rng.next() % 12, textures = 1 + rng.next() % 12;
    Problem problem;
    for (std::size_t n = 0; n < meshes; ++n) problem.mesh_bits.push_back((n > 0 ? problem.mesh_bits.back() : 0) + 1 + rng.next() % 99);
    for (std::size_t n = 0; n < textures; ++n)
      problem.texture_bits.push_back((n > 0 ? problem.texture_bits.back() : 0) + 1 + rng.next() % 99);
    std::vector<std::uint64_t> errors(meshes * textures);
    for (std::uint64_t& e : errors) e = rng.next() % 1000;  // no structure at all
    for (const StepRule rule : kRules)
      for (const Direction direction : kDirections) {
        std::multiset<std::size_t> asked;
        problem.error = [&](std::size_t i, std::size_t j) {
          asked.insert(i * textures + j);
          return errors[i * textures + j];
        };
        const Path path = marginal_analysis(problem, {.rule = rule, .direction = direction});
        CHECK(path.evaluations == asked.size());
        CHECK(std::set<std::size_t>(asked.begin(), asked.end()).size() == asked.size());
        CHECK(path.points.front().pair == Pair{0, 0});
        CHECK(path.points.back().pair == Pair{meshes - 1, textures - 1});
        if (rule != StepRule::budget) {
          CHECK(path.evaluations <= 2 * (meshes - 1 + textures - 1));
          CHECK(path.points.size() == meshes + textures - 1);
        }
        for (const PathPoint& p : path.points) {
          CHECK(p.bits == problem.bits(p.pair.mesh, p.pair.texture));
          if (p.error) CHECK(*p.error == errors[p.pair.mesh * textures + p.pair.texture]);
        }
        for (std::size_t n = 1; n < path.points.size(); ++n) {
          const Pair a = path.points[n - 1].pair, b = path.points[n].pair;
          CHECK(b.mesh >= a.mesh);
          CHECK(b.texture >= a.texture);
          CHECK(path.points[n].bits > path.points[n - 1].bits);
        }
      }
  }
}

TEST_CASE("where mesh and texture are independent and convex, slope finds only pairs of least error, in either direction") {
  // Then every greedy pair is a vertex of the lower convex hull of all pairs: no pair of as few bits has less error.
  Rng rng(11);
  for (int round = 0; round < 30; ++round) {
    const ConvexCurve mesh = convex_curve(rng, 2 + rng.next() % 20, 0), texture = convex_curve(rng, 2 + rng.next() % 20, 1);
    const Problem problem = separable_problem(mesh.bits, mesh.errors, texture.bits, texture.errors);
    const AllPairs all = evaluate_all(problem);
    const Staircase staircase(problem, all);
    for (const Direction direction : kDirections)
      for (const PathPoint& p : with_errors(marginal_analysis(problem, {.direction = direction}), all).points)
        CHECK(*p.error == staircase.at(p.bits)->error);
    for (const PathPoint& p : with_errors(independent_path(problem), all).points) CHECK(*p.error == staircase.at(p.bits)->error);
  }
}

TEST_CASE("growing can miss what pruning finds: a step that pays only after another") {
  // Mesh 1 saves 1 for 10 bits, mesh 2 then 1000 for 10: growing takes the texture's 50 for 10 first, pruning gives it up first.
  const Problem problem = separable_problem({10, 20, 30}, {1001, 1000, 0}, {10, 20}, {50, 0});
  CHECK(pairs_of(marginal_analysis(problem)) == std::vector<Pair>{{0, 0}, {1, 0}, {2, 0}, {2, 1}});
  CHECK(pairs_of(marginal_analysis(problem, {.direction = Direction::grow})) == std::vector<Pair>{{0, 0}, {0, 1}, {1, 1}, {2, 1}});
}

TEST_CASE("budget: whole levels until B bits are removed, or half of it from both") {
  const Problem problem = separable_problem({0, 10, 20, 30, 40}, {8, 6, 4, 2, 0}, {0, 10, 20, 30, 40}, {8, 6, 4, 2, 0});
  // 20 bits of either raise the error by 4; so do 10 + 10: all slopes are equal, the mesh's comes first.
  const Path path = marginal_analysis(problem, {.rule = StepRule::budget, .budget_bits = 20});
  CHECK(pairs_of(path) == std::vector<Pair>{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {2, 4}, {4, 4}});
  // Removing both is best where each alone is dear.
  Problem both = problem;
  both.error = [](std::size_t i, std::size_t j) -> std::uint64_t { return (i > j ? i - j : j - i) * 100 + 8 - i - j; };
  CHECK(pairs_of(marginal_analysis(both, {.rule = StepRule::budget, .budget_bits = 20})) ==
        std::vector<Pair>{{0, 0}, {1, 1}, {2, 2}, {3, 3}, {4, 4}});
}

TEST_CASE("one-sided paths evaluate nothing") {
  Problem problem = separable_problem({1, 2, 3}, {2, 1, 0}, {1, 5}, {9, 0});
  problem.error = [](std::size_t, std::size_t) -> std::uint64_t { throw InternalError("asked"); };
  const Path texture = one_sided_path(problem, OneSided::texture_pruned_first), mesh = one_sided_path(problem, OneSided::mesh_pruned_first);
  CHECK(pairs_of(texture) == std::vector<Pair>{{0, 0}, {1, 0}, {2, 0}, {2, 1}});
  CHECK(pairs_of(mesh) == std::vector<Pair>{{0, 0}, {0, 1}, {1, 1}, {2, 1}});
  CHECK(texture.evaluations == 0);
  CHECK_FALSE(texture.points[1].error.has_value());
}

TEST_CASE("the independent allocation asks only for pairs of a finest level") {
  Problem problem = separable_problem({1, 2, 3, 4}, {20, 10, 4, 0}, {1, 2, 3}, {9, 3, 0});
  const auto inner = problem.error;
  problem.error = [&](std::size_t i, std::size_t j) {
    CHECK((i == 3 || j == 2));
    return inner(i, j);
  };
  CHECK(independent_path(problem).evaluations <= 6);
}

TEST_CASE("one level of each is a path of one pair") {
  const Path path = marginal_analysis(separable_problem({5}, {1}, {6}, {2}));
  CHECK(pairs_of(path) == std::vector<Pair>{{0, 0}});
  CHECK(path.points[0].bits == 11);
  CHECK(path.evaluations == 0);
}

TEST_CASE("problems that are none are refused") {
  CHECK_THROWS_AS((void)marginal_analysis(Problem{}), InputError);
  CHECK_THROWS_AS((void)marginal_analysis(separable_problem({2, 1}, {0, 0}, {1}, {0})), InputError);
  CHECK_THROWS_AS((void)marginal_analysis(separable_problem({1}, {0}, {}, {})), InputError);
  CHECK_THROWS_AS((void)one_sided_path(separable_problem({std::uint64_t{1} << 62}, {0}, {1}, {0}), OneSided::mesh_pruned_first),
                  InputError);
  CHECK_THROWS_AS((void)independent_path(Problem{{1}, {1}, {}}), InputError);
  CHECK_THROWS_AS((void)marginal_analysis(separable_problem({1, 2}, {~std::uint64_t{0}, 0}, {1, 2}, {0, 0})), InternalError);
}
