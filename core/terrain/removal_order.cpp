#include "core/terrain/removal_order.h"

#include <algorithm>

#include "core/terrain/domain_pruning.h"
#include "core/terrain/quadtree.h"

namespace etalon::terrain {

namespace {

// Points of each level, in index order, coarsest level first.
std::vector<std::vector<std::uint32_t>> points_by_level(int bits) {
  std::vector<std::vector<std::uint32_t>> levels(static_cast<std::size_t>(2 * bits));
  const int side = (1 << bits) + 1;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const int level = split_of(bits, {i, j}).level;
      if (level >= 0) levels[static_cast<std::size_t>(level)].push_back(point_index(bits, {i, j}));
    }
  return levels;
}

std::vector<std::uint32_t> saturated_order(const HeightField& field, std::span<const double> weights) {
  std::vector<double> errors = split_errors(field, weights);
  const std::vector<std::vector<std::uint32_t>> levels = points_by_level(field.bits);
  std::vector<std::uint32_t> order;
  order.reserve(field.point_count());
  for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
    for (const std::uint32_t v : *level) {
      const GridPoint p = point_at(field.bits, v);
      for_each_child(field.bits, p, split_of(field.bits, p),
                     [&](GridPoint child) { errors[v] = std::max(errors[v], errors[point_index(field.bits, child)]); });
    }
    order.insert(order.end(), level->begin(), level->end());
  }
  // Finest level first already: a stable sort keeps children before parents of the same error.
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return errors[a] < errors[b]; });
  return order;
}

}  // namespace

RemovalOrder removal_order(const HeightField& field, const PruningOptions& options) {
  const MergeCosts merge = merge_costs(field, options.weights);
  RemovalOrder result;
  result.quantum = merge.quantum;
  if (options.rule == PruningRule::saturated)
    result.points = saturated_order(field, options.weights);
  else
    result.points = DomainPruning(field.bits, merge.costs).order(options.progress);
  result.costs.reserve(result.points.size());
  for (const std::uint32_t v : result.points) result.costs.push_back(merge.costs[v]);
  return result;
}

}  // namespace etalon::terrain
