#include "validation/joint/path_gaps.h"

#include <doctest/doctest.h>

using namespace etalon;
using namespace etalon::joint;
using namespace etalon::validation;

namespace {

// Errors 1000 100 10 1 over bits 10 20 20 30: the better pair of 20 bits is mesh 0 with texture 1.
Problem four_pairs() {
  Problem problem{{5, 15}, {5, 15}, {}};
  problem.error = [](std::size_t i, std::size_t j) -> std::uint64_t { return i == 0 ? (j == 0 ? 1000 : 10) : (j == 0 ? 100 : 1); };
  return problem;
}

Path path_by(const Problem& problem, const std::vector<Pair>& pairs) {
  Path path;
  for (const Pair& p : pairs) path.points.push_back({p, problem.bits(p.mesh, p.texture), {}});
  return path;
}

}  // namespace

TEST_CASE("a gap is the PSNR lost against the best pair of no more bits") {
  const Problem problem = four_pairs();
  const AllPairs all = evaluate_all(problem);
  const Staircase staircase(problem, all);
  const PathGaps best = path_gaps(path_by(problem, {{0, 0}, {0, 1}, {1, 1}}), all, staircase);
  CHECK(best.max_db == 0);
  CHECK(best.mean_db == 0);
  CHECK(best.budget_max_db == 0);
  CHECK(best.points == 3);
  // 100 against 10: ten decibel, at one of three points, and at the budgets from 20 to 29 bits.
  const PathGaps other = path_gaps(path_by(problem, {{0, 0}, {1, 0}, {1, 1}}), all, staircase);
  CHECK(other.max_db == doctest::Approx(10).epsilon(1e-12));
  CHECK(other.mean_db == doctest::Approx(10.0 / 3).epsilon(1e-12));
  CHECK(other.worst == Pair{1, 0});
  CHECK(other.budget_max_db == doctest::Approx(10).epsilon(1e-12));
  CHECK(other.budget_mean_db > 0);
  CHECK(other.budget_mean_db < 10);
}

TEST_CASE("a path that jumps over pairs shows only in the gaps by budget") {
  const Problem problem = four_pairs();
  const AllPairs all = evaluate_all(problem);
  const PathGaps gaps = path_gaps(path_by(problem, {{0, 0}, {1, 1}}), all, Staircase(problem, all));
  CHECK(gaps.max_db == 0);
  CHECK(gaps.budget_max_db == doctest::Approx(20).epsilon(1e-12));  // 1000 against 10
}

TEST_CASE("no finite gap where the best pair has no error") {
  Problem problem = four_pairs();
  problem.error = [](std::size_t i, std::size_t j) -> std::uint64_t { return i == 0 && j == 1 ? 0 : 8; };
  const AllPairs all = evaluate_all(problem);
  const PathGaps gaps = path_gaps(path_by(problem, {{0, 0}, {1, 0}, {1, 1}}), all, Staircase(problem, all));
  CHECK(gaps.infinite == 2);
  CHECK(gaps.points == 1);
  CHECK(gaps.max_db == 0);
}
