// Nearest points of a surface, found through a tree of boxes.
#pragma once

#include <limits>
#include <memory>
#include <span>

#include "core/math/nearest_point.h"
#include "core/mesh/mesh.h"

namespace etalon {

/// Where a query fell on a surface.
struct SurfacePoint {
  FaceId face;                                                 ///< invalid in a hint that says nothing
  Vec3d weights{0, 0, 0};                                      ///< of the face's corners
  Vec3d point{0, 0, 0};                                        ///< in model units
  double distance2 = std::numeric_limits<double>::infinity();  ///< squared distance to the query, model units²
};

/// A bounding volume hierarchy of a mesh's faces, four children a node, split at object medians. Queries are const and may run in parallel.
/// Memory: about 150 bytes a face.
class TriangleTree {
 public:
  /// InputError where the mesh has no faces, an index is out of range or a position is not finite. Copies what it needs.
  explicit TriangleTree(const Mesh& mesh);
  ~TriangleTree();
  TriangleTree(TriangleTree&&) noexcept;
  TriangleTree& operator=(TriangleTree&&) noexcept;

  /// The nearest point of the surface: the least distance2 that nearest_on_triangle() gives for any face, and of the faces that give it the lowest;
  /// to the last bit what asking every face would answer. p: finite, |coordinates| at most 2^60 times the mesh's.
  /// `hint`: an answer to a query nearby, which only saves time.
  [[nodiscard]] SurfacePoint nearest(const Vec3d& p, FaceId hint = {}) const;

  /// found[i] = nearest(points[i]), to the last bit; points near each other share the way through the tree, so that many at once take a third of the
  /// time of one by one. `found`: as many as `points`.
  void nearest(std::span<const Vec3d> points, std::span<SurfacePoint> found) const;

  struct Impl;

 private:
  class Groups;
  std::unique_ptr<Impl> impl_;
};

}  // namespace etalon
