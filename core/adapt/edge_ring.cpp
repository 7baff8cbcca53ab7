#include "core/adapt/edge_ring.h"

#include "core/mesh/exact_orientation.h"

namespace etalon::adapt {

std::vector<std::array<std::uint16_t, 3>> triangles_before(const EdgeRing& ring) {
  const std::size_t n = ring.size();
  const auto node = [&](std::size_t k) { return static_cast<std::uint16_t>(kFirstRingNode + k % n); };
  std::vector<std::array<std::uint16_t, 3>> triangles;
  for (std::size_t k = 0; k < n; ++k) triangles.push_back({k < ring.last_of_u ? kNodeU : kNodeV, node(k), node(k + 1)});
  triangles.push_back({kNodeU, kNodeV, node(0)});
  triangles.push_back({kNodeV, kNodeU, node(ring.last_of_u)});
  return triangles;
}

bool is_unfolded(const EdgeRing& ring) {
  const auto place = [&](std::uint16_t node) -> const Vec2f& {
    return node == kNodeU ? ring.uv_of_u : node == kNodeV ? ring.uv_of_v : ring.uv[node - kFirstRingNode];
  };
  for (const auto& [a, b, c] : triangles_before(ring))
    if (orientation(place(a), place(b), place(c)) <= 0) return false;
  for (std::size_t k = 0; k < ring.size(); ++k)
    if (orientation(ring.uv_of_w, ring.uv[k], ring.uv[(k + 1) % ring.size()]) <= 0) return false;
  return true;
}

}  // namespace etalon::adapt
