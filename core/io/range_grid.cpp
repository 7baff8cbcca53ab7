#include "core/io/range_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/mesh/range_image.h"

namespace etalon::io {
namespace {

/// Median distance in the plane of neighbours in a row; 0 where there are none.
double median_spacing(const RangeGrid& grid, const std::vector<Vec3f>& positions) {
  std::vector<double> distances;
  for (std::size_t s = 0; s + 1 < grid.vertices.size(); ++s) {
    const std::uint32_t a = grid.vertices[s], b = grid.vertices[s + 1];
    if ((s + 1) % grid.columns == 0 || a == RangeGrid::kNoSample || b == RangeGrid::kNoSample) continue;
    const double dx = double{positions[b].x} - positions[a].x, dy = double{positions[b].y} - positions[a].y;
    distances.push_back(std::sqrt(dx * dx + dy * dy));
  }
  if (distances.empty()) return 0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

/// Twice the area seen from +z.
double plane_area(const std::array<std::uint32_t, 3>& face, const std::vector<Vec3f>& positions) {
  const Vec3f &a = positions[face[0]], &b = positions[face[1]], &c = positions[face[2]];
  return (double{b.x} - a.x) * (double{c.y} - a.y) - (double{b.y} - a.y) * (double{c.x} - a.x);
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> range_grid_faces(const RangeGrid& grid, const std::vector<Vec3f>& positions,
                                                           std::optional<double> max_jump) {
  std::vector<float> depth(grid.vertices.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t s = 0; s < depth.size(); ++s)
    if (grid.vertices[s] != RangeGrid::kNoSample) depth[s] = positions[grid.vertices[s]].z;
  const double jump = max_jump.value_or(4 * median_spacing(grid, positions));
  std::vector<std::array<std::uint32_t, 3>> faces =
      grid_triangles(static_cast<int>(grid.columns), static_cast<int>(grid.rows), depth, jump);
  double area = 0;
  for (auto& face : faces) {
    for (std::uint32_t& v : face) v = grid.vertices[v];
    area += plane_area(face, positions);
  }
  if (area < 0)
    for (auto& face : faces) std::swap(face[1], face[2]);
  return faces;
}

}  // namespace etalon::io
