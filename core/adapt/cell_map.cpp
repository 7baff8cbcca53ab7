#include "core/adapt/cell_map.h"

#include <algorithm>

namespace etalon::adapt {
namespace {

double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }

}  // namespace

std::optional<Vec2d> map_point(const RingCells& cells, AdaptDirection direction, const Vec2d& p) {
  const bool to_before = direction == AdaptDirection::to_before;
  const auto from = [&](std::uint16_t n) { return Vec2d(to_before ? cells.nodes[n].after : cells.nodes[n].before); };
  const auto to = [&](std::uint16_t n) { return Vec2d(to_before ? cells.nodes[n].before : cells.nodes[n].after); };
  // What rounding leaves outside of all cells belongs to the nearest: the one whose least weight is largest.
  constexpr double kOutside = -0x1p-40;
  double best = kOutside;
  std::optional<Vec2d> result;
  for (const auto& cell : cells.cells) {
    const Vec2d a = from(cell[0]), ab = from(cell[1]) - a, ac = from(cell[2]) - a, ap = p - a;
    const double area = cross(ab, ac), v = cross(ap, ac) / area, w = cross(ab, ap) / area;
    const double least = std::min({1 - v - w, v, w});
    if (!(least > best)) continue;
    best = std::min(least, 0.0);
    const Vec2d target = to(cell[0]);
    result = target + v * (to(cell[1]) - target) + w * (to(cell[2]) - target);
    if (least >= 0) break;
  }
  return result;
}

}  // namespace etalon::adapt
