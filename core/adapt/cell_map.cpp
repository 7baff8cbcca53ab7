#include "core/adapt/cell_map.h"

#include <algorithm>
#include <cmath>

namespace etalon::adapt {
namespace {

double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }
double squared_length(const Vec2d& a) { return a.x * a.x + a.y * a.y; }

}  // namespace

std::optional<Vec2d> map_point(const RingCells& cells, AdaptDirection direction, const Vec2d& p) {
  return map_point(cells.nodes, cells.cells, direction, p);
}

std::optional<Vec2d> map_point(std::span<const CellNode> nodes, std::span<const std::array<std::uint16_t, 3>> cells,
                               AdaptDirection direction, const Vec2d& p) {
  const bool to_before = direction == AdaptDirection::to_before;
  const auto from = [&](std::uint16_t n) { return Vec2d(to_before ? nodes[n].after : nodes[n].before); };
  const auto to = [&](std::uint16_t n) { return Vec2d(to_before ? nodes[n].before : nodes[n].after); };
  double best = 0;  // least weight of the best cell so far, 0 once p is inside one
  std::optional<Vec2d> result;
  for (const auto& cell : cells) {
    const Vec2d a = from(cell[0]), ab = from(cell[1]) - a, ac = from(cell[2]) - a, ap = p - a;
    const double area = cross(ab, ac), v = cross(ap, ac) / area, w = cross(ab, ap) / area;
    const double least = std::min({1 - v - w, v, w});
    // Between two cells rounding may leave p outside of both; it belongs to the nearer. Each weight is two products of rounded differences,
    // their difference and a quotient: off by less than 4u(|ap|² + |e|²)/area with u = 2^-53 and e its other side; 1 − v − w by the sum of
    // both and two roundings more: below 2^-50 of the squares over the area.
    const double rounding = 0x1p-50 * (squared_length(ab) + squared_length(ac) + squared_length(ap)) / std::abs(area);
    if (least < -rounding || (result && least <= best)) continue;
    best = std::min(least, 0.0);
    const Vec2d target = to(cell[0]);
    result = target + v * (to(cell[1]) - target) + w * (to(cell[2]) - target);
    if (least >= 0) break;
  }
  return result;
}

}  // namespace etalon::adapt
