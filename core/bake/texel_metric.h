// How far texel centres are from each other in space: whole numbers, so that sums of distances are exact and every order of computing them
// gives the same.
#pragma once

#include <cmath>

#include "core/bake/atlas.h"

namespace etalon::bake {

/// A place in space on a grid of 2^30 steps or fewer along the longest side of the mesh's box, each coordinate 0 to 2^30.
struct GridPoint {
  std::int32_t x = 0, y = 0, z = 0;
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

/// In grid steps, squared: at most 3·2^60.
[[nodiscard]] inline std::uint64_t squared_grid_distance(const GridPoint& a, const GridPoint& b) {
  const std::int64_t dx = std::int64_t{a.x} - b.x, dy = std::int64_t{a.y} - b.y, dz = std::int64_t{a.z} - b.z;
  return static_cast<std::uint64_t>(dx * dx + dy * dy + dz * dz);
}

/// The distance in grid steps, rounded up: at most 2^31. Rounded up it still obeys the triangle inequality, exactly.
[[nodiscard]] inline std::uint64_t grid_distance(const GridPoint& a, const GridPoint& b) {
  const std::uint64_t squared = squared_grid_distance(a, b);
  auto root = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(squared)));
  while (root * root < squared) ++root;
  while (root > 0 && (root - 1) * (root - 1) >= squared) --root;
  return root;
}

/// The plane of one face's texel centres, in grid steps.
struct TexelPlane {
  Vec3d corner{0, 0, 0}, along_i{0, 0, 0}, along_j{0, 0, 0};  ///< the corner at (0, 0); from one texel to the next

  /// The centre of texel (i, j), rounded to the grid.
  [[nodiscard]] GridPoint center(int i, int j) const {
    const double s = i + 0.5, t = j + 0.5;
    const auto on_grid = [](double x) { return static_cast<std::int32_t>((x > 0 ? x : 0) + 0.5); };
    return {on_grid(corner.x + (s * along_i.x + t * along_j.x)), on_grid(corner.y + (s * along_i.y + t * along_j.y)),
            on_grid(corner.z + (s * along_i.z + t * along_j.z))};
  }
};

class TexelMetric {
 public:
  /// Both must outlive it.
  TexelMetric(const Mesh& mesh, const Atlas& atlas);

  [[nodiscard]] TexelPlane plane(std::uint32_t face) const;
  /// Model units per grid step: a power of two.
  [[nodiscard]] double step_length() const { return step_length_; }

 private:
  const Mesh& mesh_;
  const Atlas& atlas_;
  Vec3d low_{0, 0, 0};
  double step_length_ = 1;
};

}  // namespace etalon::bake
