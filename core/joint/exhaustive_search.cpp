#include "core/joint/exhaustive_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "core/base/error.h"
#include "core/joint/geometric.h"

namespace etalon::joint {

AllPairs evaluate_all(const Problem& problem, const std::function<void(std::size_t, std::size_t)>& progress) {
  validate(problem);
  AllPairs all{problem.mesh_bits.size(), problem.texture_bits.size(), {}};
  all.errors.resize(all.mesh_count * all.texture_count);
  for (std::size_t i = all.mesh_count; i-- > 0;) {
    if (progress) progress((all.mesh_count - 1 - i) * all.texture_count, all.errors.size());
    const auto row = all.errors.begin() + static_cast<std::ptrdiff_t>(i * all.texture_count);
    if (problem.errors_of_mesh) {
      const std::vector<std::uint64_t> errors = problem.errors_of_mesh(i);
      ETALON_CHECK(errors.size() == all.texture_count, std::to_string(errors.size()));
      std::ranges::copy(errors, row);
    } else {
      for (std::size_t j = all.texture_count; j-- > 0;) row[static_cast<std::ptrdiff_t>(j)] = problem.error(i, j);
    }
  }
  return all;
}

Staircase::Staircase(const Problem& problem, const AllPairs& all) {
  std::vector<Stair> pairs;
  for (std::size_t i = 0; i < all.mesh_count; ++i)
    for (std::size_t j = 0; j < all.texture_count; ++j) pairs.push_back({problem.bits(i, j), all.error({i, j}), {i, j}});
  std::ranges::sort(pairs, {}, [](const Stair& s) { return std::tuple(s.bits, s.error, s.pair.mesh, s.pair.texture); });
  for (const Stair& s : pairs)
    if (stairs_.empty() || s.error < stairs_.back().error) stairs_.push_back(s);
}

const Staircase::Stair* Staircase::at(std::uint64_t budget_bits) const {
  const auto above = std::ranges::upper_bound(stairs_, budget_bits, {}, &Stair::bits);
  return above == stairs_.begin() ? nullptr : &*(above - 1);
}

Path with_errors(Path path, const AllPairs& all) {
  for (PathPoint& point : path.points) point.error = all.error(point.pair);
  return path;
}

const PathPoint* point_within(const Path& path, std::uint64_t budget_bits) {
  const auto above = std::ranges::upper_bound(path.points, budget_bits, {}, &PathPoint::bits);
  return above == path.points.begin() ? nullptr : &*(above - 1);
}

std::vector<std::uint64_t> log_spaced_budgets(std::uint64_t low, std::uint64_t high, std::size_t count) {
  if (low < 1 || high <= low || high >= std::uint64_t{1} << 62 || count < 2)
    throw InputError(fmt::format("budgets: expected at least 2 from 1 <= low < high, got {} from {} to {}", count, low, high));
  std::vector<std::uint64_t> budgets;
  for (const double at : geometric_progression(static_cast<double>(low), static_cast<double>(high), count))
    budgets.push_back(std::clamp(static_cast<std::uint64_t>(std::nearbyint(at)), low, high));
  return budgets;
}

}  // namespace etalon::joint
