#include "core/joint/exhaustive_search.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/base/error.h"
#include "tests/joint/problems.h"

using namespace etalon;
using namespace etalon::joint;
using namespace etalon::test;

TEST_CASE("a mesh's errors with all textures at once are taken as those of its pairs") {
  Problem problem{{1, 2, 4}, {1, 3}, [](std::size_t i, std::size_t j) { return 10 * i + j; }, {}};
  const AllPairs one_by_one = evaluate_all(problem);
  std::vector<std::size_t> asked;
  problem.error = [](std::size_t, std::size_t) -> std::uint64_t { throw InternalError("not asked for"); };
  problem.errors_of_mesh = [&](std::size_t i) {
    asked.push_back(i);
    return std::vector<std::uint64_t>{10 * i, 10 * i + 1};
  };
  CHECK(evaluate_all(problem).errors == one_by_one.errors);
  CHECK(asked == std::vector<std::size_t>{2, 1, 0});
  problem.errors_of_mesh = [](std::size_t) { return std::vector<std::uint64_t>{1}; };
  CHECK_THROWS_AS((void)evaluate_all(problem), InternalError);
}

TEST_CASE("the staircase is the least error over all pairs of at most b bits, for every b") {
  Rng rng(5);
  for (int round = 0; round < 40; ++round) {
    Problem problem;
    const std::size_t meshes = 1 + rng.next() % 8, textures = 1 + rng.next() % 8;
    for (std::size_t n = 0; n < meshes; ++n) problem.mesh_bits.push_back((n > 0 ? problem.mesh_bits.back() : 0) + rng.next() % 20);
    for (std::size_t n = 0; n < textures; ++n) problem.texture_bits.push_back((n > 0 ? problem.texture_bits.back() : 0) + rng.next() % 20);
    std::vector<std::uint64_t> errors(meshes * textures);
    for (std::uint64_t& e : errors) e = rng.next() % 100;
    problem.error = [&](std::size_t i, std::size_t j) { return errors[i * textures + j]; };
    const Staircase staircase(problem, evaluate_all(problem));
    for (std::uint64_t budget = 0; budget < 400; ++budget) {
      std::optional<std::uint64_t> least;
      for (std::size_t i = 0; i < meshes; ++i)
        for (std::size_t j = 0; j < textures; ++j)
          if (problem.bits(i, j) <= budget) least = std::min(least.value_or(~std::uint64_t{0}), errors[i * textures + j]);
      const Staircase::Stair* stair = staircase.at(budget);
      REQUIRE((stair != nullptr) == least.has_value());
      if (stair == nullptr) continue;
      CHECK(stair->error == *least);
      CHECK(stair->bits <= budget);
      CHECK(problem.bits(stair->pair.mesh, stair->pair.texture) == stair->bits);
      CHECK(errors[stair->pair.mesh * textures + stair->pair.texture] == stair->error);
    }
    for (std::size_t n = 1; n < staircase.stairs().size(); ++n) {
      CHECK(staircase.stairs()[n].bits > staircase.stairs()[n - 1].bits);
      CHECK(staircase.stairs()[n].error < staircase.stairs()[n - 1].error);
    }
  }
}

TEST_CASE("budgets below the smallest pair reach nothing, those above the largest the best of all") {
  const Problem problem = separable_problem({10, 20}, {5, 0}, {3, 4}, {2, 0});
  const Staircase staircase(problem, evaluate_all(problem));
  CHECK(staircase.at(12) == nullptr);
  CHECK(staircase.at(13)->pair == Pair{0, 0});
  CHECK(staircase.at(std::uint64_t{1} << 60)->pair == Pair{1, 1});
  Path path;
  path.points = {{{0, 0}, 13, {}}, {{1, 1}, 24, {}}};
  CHECK(point_within(path, 12) == nullptr);
  CHECK(point_within(path, 23)->pair == Pair{0, 0});
  CHECK(point_within(path, 24)->pair == Pair{1, 1});
  CHECK(point_within(path, 1'000'000)->pair == Pair{1, 1});
}

TEST_CASE("all pairs are asked for once, mesh by mesh, finest first") {
  std::vector<Pair> asked;
  Problem problem{{1, 2}, {1, 2, 3}, [&](std::size_t i, std::size_t j) {
                    asked.push_back({i, j});
                    return std::uint64_t{i * 10 + j};
                  }};
  const AllPairs all = evaluate_all(problem);
  CHECK(asked == std::vector<Pair>{{1, 2}, {1, 1}, {1, 0}, {0, 2}, {0, 1}, {0, 0}});
  CHECK(all.error({1, 2}) == 12);
  CHECK(with_errors(Path{{{{1, 0}, 3, {}}}, 0}, all).points[0].error == std::uint64_t{10});
}

TEST_CASE("budgets in geometric progression") {
  CHECK(log_spaced_budgets(1, 1000, 4) == std::vector<std::uint64_t>{1, 10, 100, 1000});
  const auto many = log_spaced_budgets(1000, 123'456'789, 200);
  CHECK(many.size() == 200);
  CHECK(many.back() == 123'456'789);
  CHECK(std::ranges::is_sorted(many));
  for (std::size_t n = 2; n < many.size(); ++n)  // each is the last one's ratio further, to the rounding of both
    CHECK(static_cast<double>(many[n]) / static_cast<double>(many[n - 1]) ==
          doctest::Approx(static_cast<double>(many[1]) / 1000).epsilon(1e-3));
  CHECK_THROWS_AS((void)log_spaced_budgets(0, 10, 3), InputError);
  CHECK_THROWS_AS((void)log_spaced_budgets(10, 10, 3), InputError);
  CHECK_THROWS_AS((void)log_spaced_budgets(1, 10, 1), InputError);
}
