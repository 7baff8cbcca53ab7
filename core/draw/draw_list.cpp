#include "core/draw/draw_list.h"

#include <algorithm>

namespace etalon {

const Draw& DrawList::draw_of(std::uint32_t t) const {
  const auto after =
      std::upper_bound(draws.begin(), draws.end(), t, [](std::uint32_t id, const Draw& draw) { return id < draw.first_triangle; });
  return *std::prev(after);
}

}  // namespace etalon
