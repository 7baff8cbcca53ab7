#include "core/mesh/uv_overlap.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <optional>
#include <vector>

#include "core/base/error.h"

namespace etalon {

namespace {

constexpr std::int64_t kSub = 256;
constexpr float kFarthest = 1024;  // 1024·2048·256 = 2^29: products of differences stay below 2^61

/// A face's corners on the grid, in 1/256 cell, counter-clockwise, the least one first: equal triangles are equal.
struct GridTriangle {
  std::array<std::array<std::int32_t, 2>, 3> corner;
  std::uint32_t face;
  friend auto operator<=>(const GridTriangle&, const GridTriangle&) = default;
};

/// Nothing where a corner is too far, no number, or the triangle has no area.
std::optional<GridTriangle> grid_triangle(const Mesh& mesh, std::uint32_t face, int grid) {
  GridTriangle result{{}, face};
  for (int k = 0; k < 3; ++k) {
    const Vec2f uv = mesh.wedge(FaceId(face), k).uv;
    if (!(std::fabs(uv.x) <= kFarthest && std::fabs(uv.y) <= kFarthest)) return std::nullopt;
    result.corner[static_cast<std::size_t>(k)] = {static_cast<std::int32_t>(std::floor(static_cast<double>(uv.x) * grid * kSub + 0.5)),
                                                  static_cast<std::int32_t>(std::floor(static_cast<double>(uv.y) * grid * kSub + 0.5))};
  }
  const auto& [a, b, c] = result.corner;
  const std::int64_t area =
      (std::int64_t{b[0]} - a[0]) * (std::int64_t{c[1]} - a[1]) - (std::int64_t{b[1]} - a[1]) * (std::int64_t{c[0]} - a[0]);
  if (area == 0) return std::nullopt;
  if (area < 0) std::swap(result.corner[1], result.corner[2]);
  std::rotate(result.corner.begin(), std::min_element(result.corner.begin(), result.corner.end()), result.corner.end());
  return result;
}

std::int64_t floor_quotient(std::int64_t a, std::int64_t b) { return a / b - ((a % b != 0) && ((a < 0) != (b < 0))); }

/// Calls visit(y, first, last) for the cells of each row whose centre the triangle owns.
template <class Visit>
void for_each_span(const GridTriangle& triangle, int grid, const Visit& visit) {
  const auto& corner = triangle.corner;
  const auto [low, high] = std::minmax({corner[0][1], corner[1][1], corner[2][1]});
  const std::int64_t y0 = std::max<std::int64_t>(0, (low + kSub / 2 - 1) >> 8),
                     y1 = std::min<std::int64_t>(grid - 1, (high - kSub / 2) >> 8);
  for (std::int64_t y = y0; y <= y1; ++y) {
    std::int64_t first = 0, last = grid - 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t px = corner[k][0], py = corner[k][1], dx = corner[(k + 1) % 3][0] - px, dy = corner[(k + 1) % 3][1] - py;
      // Owned: dx·(y − py) − dy·(x − px) > 0 at the centre, or = 0 on an edge that owns its points; as dy·256·column <= limit.
      const std::int64_t owns = dy < 0 || (dy == 0 && dx > 0) ? 0 : 1;
      const std::int64_t limit = dx * (y * kSub + kSub / 2 - py) - dy * (kSub / 2 - px) - owns;
      if (dy > 0) last = std::min(last, floor_quotient(limit, dy * kSub));
      if (dy < 0) first = std::max(first, -floor_quotient(limit, -dy * kSub));
      if (dy == 0 && limit < 0) last = -1;
    }
    if (first <= last) visit(y, first, last);
  }
}

/// Which face was first in each cell, and which cells have two: these are passed over, so that each cell is looked at twice at most.
class CellOwners {
 public:
  explicit CellOwners(int grid) : grid_(static_cast<std::size_t>(grid)), owner_(grid_ * grid_, kFree), next_(grid_ * (grid_ + 1)) {
    for (std::size_t i = 0; i < next_.size(); ++i) next_[i] = static_cast<std::uint16_t>(i % (grid_ + 1));
  }

  /// Face f owns cells first..last of row y; every face that shares one with another is marked.
  void cover(std::uint32_t f, std::int64_t y, std::int64_t first, std::int64_t last, UvOverlap& result, std::vector<bool>& shared_face) {
    const auto row = static_cast<std::size_t>(y), end = static_cast<std::size_t>(last) + 1;
    for (auto x = static_cast<std::size_t>(first); x < end; ++x) {
      const std::size_t open = open_cell(row, x);
      if (open > x) shared_face[f] = true;
      if (open >= end) return;
      x = open;
      std::uint32_t& owner = owner_[row * grid_ + x];
      if (owner == kFree) {
        owner = f;
        ++result.covered_cells;
      } else {
        shared_face[f] = shared_face[owner] = true;
        ++result.overlapped_cells;
        next_[row * (grid_ + 1) + x] = static_cast<std::uint16_t>(x + 1);
      }
    }
  }

 private:
  static constexpr std::uint32_t kFree = 0xFFFFFFFFu;

  /// The first cell of the row from x on that has no two faces; the grid's side where there is none. Union-find with halved paths.
  std::size_t open_cell(std::size_t row, std::size_t x) {
    std::uint16_t* next = &next_[row * (grid_ + 1)];
    while (next[x] != x) {
      next[x] = next[next[x]];
      x = next[x];
    }
    return x;
  }

  std::size_t grid_;
  std::vector<std::uint32_t> owner_;
  std::vector<std::uint16_t> next_;
};

}  // namespace

UvOverlap measure_uv_overlap(const Mesh& mesh, int grid, std::size_t list_limit) {
  ETALON_CHECK(grid >= 1 && grid <= 2048, fmt::format("grid {}", grid));
  UvOverlap result;
  result.grid = grid;
  std::vector<GridTriangle> triangles;
  triangles.reserve(mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    if (const auto triangle = grid_triangle(mesh, f, grid)) triangles.push_back(*triangle);
  // No count depends on the order of faces. Of equal triangles (a repeated texture has thousands) the third finds all its cells shared.
  std::sort(triangles.begin(), triangles.end());
  CellOwners owners(grid);
  std::vector<bool> shared_face(mesh.face_count(), false);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const GridTriangle& triangle = triangles[i];
    if (i >= 2 && triangle.corner == triangles[i - 2].corner) {
      shared_face[triangle.face] = shared_face[triangles[i - 1].face];
      continue;
    }
    for_each_span(triangle, grid, [&](std::int64_t y, std::int64_t first, std::int64_t last) {
      owners.cover(triangle.face, y, first, last, result, shared_face);
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
