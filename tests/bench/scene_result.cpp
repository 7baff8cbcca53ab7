#include "tests/bench/scene_result.h"

#include <algorithm>

namespace etalon::bench {

std::vector<double> SceneResult::times_of(const std::string& wanted) const {
  const auto found = std::ranges::find(ways, wanted, &Way::name);
  return found == ways.end() ? std::vector<double>{} : found->milliseconds;
}

}  // namespace etalon::bench
