// The metric `aps`: how far a point of the texture moves in space, at most, from where it was on the input.
// [Cohen, Olano & Manocha 1998, Appearance-Preserving Simplification, sec. 5: texture deviation].
#pragma once

#include <span>
#include <vector>

#include "core/simplify/collapse_candidate.h"
#include "core/simplify/curve_planes.h"

namespace etalon::simplify {

/// Each face keeps a bound of the texture deviation over it: of the distance between its point and the input's point of the same texture
/// coordinate. A
/// collapse u→v replaces the faces of u by others that cover the same part of the texture; between them the deviation is linear in each
/// cell of
/// their overlay, so it is largest at a corner of one: at u, or where an old edge of u crosses a new one of v. The new bound of a side of
/// u's curve is the
/// largest old one plus the largest such deviation (the paper's boxes, here one number); the cost is the larger of the sides, a length in
/// the unit cube.
///
/// Beside curves texture is gained and lost: there u counts against the nearest point, in the texture, of the new faces, and of what is
/// lost nothing is
/// kept. Where a chart is of under one
/// texel (CollapseMesh::uv_sign) it counts against the nearest point in space. State: one float32 a face, rounded up; half-edge collapses.
class ApsMetric {
 public:
  static constexpr bool kCostsAreLocal = false;

  ApsMetric(const CollapseMesh& mesh, const UnitPositions& positions, const QemOptions&)
      : mesh_(mesh), places_(positions.at), bounds_(mesh.face_capacity(), 0) {}

  [[nodiscard]] double cost(std::uint32_t u, std::uint32_t v, std::uint32_t h);
  /// Takes u and its neighbours in hand (the caller keeps them), until something changes:
  void surround(std::uint32_t u, std::span<const CollapseCandidate> neighbors) {
    in_hand_ = u;
    neighbors_ = neighbors;
    bound_ = largest_bound(u);
  }
  /// the largest bound of a face of u, not above the cost of u → neighbours[i],
  [[nodiscard]] double bound_of(std::size_t) const { return bound_; }
  /// and that cost.
  [[nodiscard]] double cost_of(std::size_t i) { return cost(in_hand_, neighbors_[i].target, neighbors_[i].half_edge); }
  [[nodiscard]] double squared_distance(std::uint32_t, std::uint32_t, double cost) const { return cost * cost; }
  void collapse(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge);

  /// Of a face that is still there, in the unit cube.
  [[nodiscard]] double face_bound(std::uint32_t face) const { return bounds_[face]; }
  [[nodiscard]] std::size_t state_bytes() const { return bounds_.size() * sizeof(bounds_[0]); }

 private:
  struct Corner {
    std::uint32_t vertex;
    Vec3d uv, place;
  };
  struct Face {
    std::uint32_t face;
    Corner a, b;  // its other corners
    bool stays;
  };
  struct Side {
    std::vector<Face> faces;
    Corner u, v;
    bool textured = true;
    double largest = 0;  // of the old bounds
  };

  [[nodiscard]] double largest_bound(std::uint32_t u) const;
  void gather(std::uint32_t u, const CollapseMesh::Edge& edge);
  [[nodiscard]] double deviation(const Side& side) const;
  [[nodiscard]] static double deviation_at_vertex(const Side& side);
  [[nodiscard]] static double deviation_at_crossings(const Side& side);
  [[nodiscard]] Corner corner(std::uint32_t h) const;

  const CollapseMesh& mesh_;
  const std::vector<Vec3f>& places_;
  std::vector<float> bounds_;
  std::array<Side, 2> sides_;  // of the collapse in hand
  std::uint32_t in_hand_ = kNone;
  std::span<const CollapseCandidate> neighbors_;
  double bound_ = 0;
};

}  // namespace etalon::simplify
