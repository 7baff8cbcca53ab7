// All pairs of a problem, and the least error for every budget: equation 3 of [Horbelt, Balmelli & Vetterli].
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/joint/problem.h"

namespace etalon::joint {

/// The errors of all pairs.
struct AllPairs {
  std::size_t mesh_count = 0, texture_count = 0;
  std::vector<std::uint64_t> errors;  ///< mesh by mesh: [mesh·texture_count + texture]
  [[nodiscard]] std::uint64_t error(Pair pair) const { return errors[pair.mesh * texture_count + pair.texture]; }
};

/// Asks for every pair's error, mesh by mesh, finest first (its textures finest first): (N + 1)·(M + 1) evaluations. `progress` may be empty.
[[nodiscard]] AllPairs evaluate_all(const Problem& problem, const std::function<void(std::size_t done, std::size_t total)>& progress = {});

/// D_min of equation 3 as a function of the budget: H(b) = the least error over all pairs of at most b bits. A staircase; not interpolated, no
/// convex hull.
class Staircase {
 public:
  struct Stair {
    std::uint64_t bits = 0;   ///< from this budget on …
    std::uint64_t error = 0;  ///< … this is the least error
    Pair pair;                ///< the pair that has it; of several the one of least bits, then of the coarsest mesh
  };

  Staircase(const Problem& problem, const AllPairs& all);

  [[nodiscard]] const std::vector<Stair>& stairs() const { return stairs_; }  ///< bits strictly ascending, errors strictly descending
  /// The stair that a budget reaches; none below the smallest pair.
  [[nodiscard]] const Stair* at(std::uint64_t budget_bits) const;

 private:
  std::vector<Stair> stairs_;
};

/// Fills in the errors that a search did not ask for.
[[nodiscard]] Path with_errors(Path path, const AllPairs& all);

/// The last point of a path (in its order of bits) that a budget reaches; none below the smallest.
[[nodiscard]] const PathPoint* point_within(const Path& path, std::uint64_t budget_bits);

/// `count` >= 2 budgets from `low` >= 1 to `high` > low in geometric progression, each rounded to whole bits; without libm.
[[nodiscard]] std::vector<std::uint64_t> log_spaced_budgets(std::uint64_t low, std::uint64_t high, std::size_t count);

}  // namespace etalon::joint
