#include "tests/bench/scene_result.h"

#include <algorithm>

namespace etalon::bench {

std::vector<double> SceneResult::times_of(const std::string& wanted) const {
  const auto found = std::ranges::find(ways, wanted, &Way::name);
  return found == ways.end() ? std::vector<double>{} : found->milliseconds;
}

std::size_t SceneResult::keep_quiet_rounds(double most_others, std::size_t fewest) {
  const auto is_quiet = [&](double share) { return share <= most_others; };
  if (static_cast<std::size_t>(std::ranges::count_if(others, is_quiet)) < fewest) return others.size();
  const auto keep = [&](const std::vector<double>& values) {
    std::vector<double> kept;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (is_quiet(others[i])) kept.push_back(values[i]);
    return kept;
  };
  for (Way& way : ways) way.milliseconds = keep(way.milliseconds);
  others = keep(others);
  return others.size();
}

}  // namespace etalon::bench
