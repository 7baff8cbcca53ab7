#include "validation/joint/path_gaps.h"

#include <algorithm>

#include "core/base/error.h"
#include "validation/metrics/decibel.h"

namespace etalon::validation {
namespace {

constexpr std::size_t kBudgets = 200;

std::optional<double> gap_db(std::uint64_t error, std::uint64_t least) {
  if (error == least) return 0.0;
  if (least == 0) return std::nullopt;
  return decibel(static_cast<double>(error) / static_cast<double>(least));
}

}  // namespace

PathGaps path_gaps(const joint::Path& path, const joint::AllPairs& all, const joint::Staircase& staircase) {
  ETALON_CHECK(!path.points.empty() && !staircase.stairs().empty(), "a path and a staircase");
  PathGaps gaps;
  double sum = 0;
  for (const joint::PathPoint& point : path.points) {
    const auto gap = gap_db(all.error(point.pair), staircase.at(point.bits)->error);
    if (!gap) {
      ++gaps.infinite;
      continue;
    }
    if (*gap > gaps.max_db || gaps.points == 0) gaps.max_db = *gap, gaps.worst = point.pair;
    sum += *gap;
    ++gaps.points;
  }
  if (gaps.points > 0) gaps.mean_db = sum / static_cast<double>(gaps.points);

  const std::uint64_t low = std::max<std::uint64_t>(1, path.points.front().bits), high = path.points.back().bits;
  if (high <= low) return gaps;
  double budget_sum = 0;
  std::size_t count = 0;
  for (const std::uint64_t budget : joint::log_spaced_budgets(low, high, kBudgets)) {
    const joint::PathPoint* point = joint::point_within(path, budget);
    const auto* stair = staircase.at(budget);
    if (point == nullptr || stair == nullptr) continue;
    const auto gap = gap_db(all.error(point->pair), stair->error);
    if (!gap) continue;
    gaps.budget_max_db = std::max(gaps.budget_max_db, *gap);
    budget_sum += *gap;
    ++count;
  }
  if (count > 0) gaps.budget_mean_db = budget_sum / static_cast<double>(count);
  return gaps;
}

}  // namespace etalon::validation
