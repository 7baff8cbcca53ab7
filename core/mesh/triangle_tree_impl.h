// What the parts of the tree share; not for its users.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/mesh/four_triangles.h"
#include "core/mesh/triangle_tree.h"

namespace etalon {

inline constexpr std::uint32_t kTreeLeaf = 0x80000000u;  // child = kTreeLeaf | index into leaves, below 2^28
inline constexpr std::uint32_t kTreeNoChild = 0xFFFFFFFFu;

struct alignas(128) TreeNode {
  Float4 lo[3], hi[3];
  std::array<std::uint32_t, 4> child;
};

struct TreeTriangle {
  std::array<Vec3f, 3> corner;
  std::uint32_t face;
};

struct TriangleTree::Impl {
  std::vector<TreeNode> nodes;
  std::vector<FourTriangles> leaves;    // leaf i: triangles 4i to 4i + 3, the last of which may repeat
  std::vector<TreeTriangle> triangles;  // model units
  std::vector<std::uint32_t> slot;      // by face: index into triangles
  double scale = 1;                     // a power of two: boxes and leaves hold scale · model, below 1
  std::uint32_t root = kTreeNoChild;

  explicit Impl(const Mesh& mesh);

  static void try_triangle(const TreeTriangle& triangle, const Vec3d& p, SurfacePoint& best) {
    const auto& c = triangle.corner;
    const NearestOnTriangle found = nearest_on_triangle(p, to_double(c[0]), to_double(c[1]), to_double(c[2]));
    if (found.distance2 > best.distance2 || (found.distance2 == best.distance2 && triangle.face > best.face.index)) return;
    best = {FaceId(triangle.face), found.weights, found.point, found.distance2};
  }
  [[nodiscard]] Vec3d scaled(const Vec3d& p) const { return {p.x * scale, p.y * scale, p.z * scale}; }
  /// A squared distance in model units as the scaled float that a lower bound must exceed to be too far. Bounds are too large by less than 2^-14
  /// of themselves (BoxDistances, FourTriangles).
  [[nodiscard]] float limit_of(double distance2) const {
    const double limit = distance2 * (scale * scale) * (1 + 0x1p-14);
    return limit < 0x1p120 ? static_cast<float>(limit) : std::numeric_limits<float>::infinity();
  }
  /// Improves `best` by the triangles of a leaf; p in model units, `at` the same for the leaf.
  void try_leaf(std::uint32_t leaf, const Vec3d& p, const ScaledPoint& at, SurfacePoint& best) const {
    const Float4 distance2 = leaves[leaf].distance2(at);
    float limit = limit_of(best.distance2);
    // The least bound first: mostly it is the nearest, and the others are too far.
    std::size_t first = 0;
    for (std::size_t k = 1; k < 4; ++k)
      if (distance2[k] < distance2[first]) first = k;
    if (distance2[first] > limit) return;
    const TreeTriangle* const four = &triangles[4 * std::size_t{leaf}];
    try_triangle(four[first], p, best);
    limit = limit_of(best.distance2);
    for (std::size_t k = 0; k < 4; ++k)
      if (k != first && !(distance2[k] > limit)) {
        try_triangle(four[k], p, best);
        limit = limit_of(best.distance2);
      }
  }
  /// Improves `best`; p in model units.
  void search(const Vec3d& p, SurfacePoint& best) const;
};

/// The squared distance from a point to each of four boxes: not above what nearest_on_triangle() gives for any face in them by more than 2^-21 of
/// itself. Rounding p moves it by 2^-24 of its largest coordinate at most, and nearest_on_triangle() leaves its triangle by less; boxes are
/// widened by 2^-22 of the largest coordinate there is (the mesh's are below 1).
inline Float4 box_distance2(const Float4 (&lo)[3], const Float4 (&hi)[3], const ScaledPoint& p) {
  Float4 sum = all_four(0);
  for (int k = 0; k < 3; ++k) {
    const Float4 outside = larger(larger(lo[k] - p.at[k], p.at[k] - hi[k]) - p.slack, all_four(0));
    sum += outside * outside;
  }
  return sum;
}

}  // namespace etalon
