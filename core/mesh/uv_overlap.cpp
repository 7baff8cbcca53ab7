#include "core/mesh/uv_overlap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace etalon {

namespace {

constexpr std::int64_t kSub = 256;
constexpr float kFarthest = 1024;  // 1024·8192·256 = 2^31: edge values stay below 2^63

struct Point {
  std::int64_t x, y;
};

/// Calls visit(x, y) for the cells whose centre the triangle owns.
template <class Visit>
void for_each_cell(Point a, Point b, Point c, int grid, const Visit& visit) {
  std::int64_t area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (area == 0) return;
  if (area < 0) std::swap(b, c);
  const Point corner[3] = {a, b, c};
  const auto cell_from = [](std::int64_t s) { return (s + kSub / 2 - 1) >> 8; };  // first centre at or after s
  const auto cell_to = [](std::int64_t s) { return (s - kSub / 2) >> 8; };
  const std::int64_t x0 = std::max<std::int64_t>(0, cell_from(std::min({a.x, b.x, c.x})));
  const std::int64_t x1 = std::min<std::int64_t>(grid - 1, cell_to(std::max({a.x, b.x, c.x})));
  const std::int64_t y0 = std::max<std::int64_t>(0, cell_from(std::min({a.y, b.y, c.y})));
  const std::int64_t y1 = std::min<std::int64_t>(grid - 1, cell_to(std::max({a.y, b.y, c.y})));
  for (std::int64_t y = y0; y <= y1; ++y)
    for (std::int64_t x = x0; x <= x1; ++x) {
      bool inside = true;
      for (int k = 0; k < 3 && inside; ++k) {
        const Point p = corner[k], q = corner[(k + 1) % 3];
        const std::int64_t dx = q.x - p.x, dy = q.y - p.y;
        const std::int64_t e = dx * (y * kSub + kSub / 2 - p.y) - dy * (x * kSub + kSub / 2 - p.x);
        inside = e > 0 || (e == 0 && (dy < 0 || (dy == 0 && dx > 0)));
      }
      if (inside) visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(grid) + static_cast<std::size_t>(x));
    }
}

}  // namespace

UvOverlap measure_uv_overlap(const Mesh& mesh, int grid, std::size_t list_limit) {
  ETALON_CHECK(grid >= 1 && grid <= 8192, fmt::format("grid {}", grid));
  UvOverlap result;
  result.grid = grid;
  constexpr std::uint32_t kFree = 0xFFFFFFFFu;
  std::vector<std::uint32_t> owner(static_cast<std::size_t>(grid) * static_cast<std::size_t>(grid), kFree);
  std::vector<bool> shared_cell(owner.size(), false), shared_face(mesh.face_count(), false);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    Point corner[3];
    bool usable = true;
    for (int k = 0; k < 3; ++k) {
      const Vec2f uv = mesh.wedge(FaceId(f), k).uv;
      usable = usable && std::fabs(uv.x) <= kFarthest && std::fabs(uv.y) <= kFarthest;
      if (!usable) break;
      corner[k] = {static_cast<std::int64_t>(std::floor(static_cast<double>(uv.x) * grid * kSub + 0.5)),
                   static_cast<std::int64_t>(std::floor(static_cast<double>(uv.y) * grid * kSub + 0.5))};
    }
    if (!usable) continue;
    for_each_cell(corner[0], corner[1], corner[2], grid, [&](std::size_t cell) {
      if (owner[cell] == kFree) {
        owner[cell] = f;
        ++result.covered_cells;
        return;
      }
      shared_face[f] = shared_face[owner[cell]] = true;
      if (shared_cell[cell]) return;
      shared_cell[cell] = true;
      ++result.overlapped_cells;
    });
  }
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (!shared_face[f]) continue;
    ++result.face_count;
    if (result.first_faces.size() < list_limit) result.first_faces.push_back(FaceId(f));
  }
  return result;
}

}  // namespace etalon
