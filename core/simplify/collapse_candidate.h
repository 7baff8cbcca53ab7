// One way that a vertex could go.
#pragma once

#include <cstdint>

namespace etalon::simplify {

struct CollapseCandidate {
  std::uint32_t target = 0;     ///< engine vertex
  std::uint32_t half_edge = 0;  ///< on the edge to it, in either direction
  double cost = 0;              ///< or a bound of it
};

}  // namespace etalon::simplify
