// Follows every removed vertex over the surface while it is simplified.
#pragma once

#include <array>

#include "core/mesh/landing.h"
#include "core/simplify/collapse_mesh.h"

namespace etalon::simplify {

/// A vertex lands, when it is removed, on the nearest point of the faces that replace its own, and moves on to the nearest point of what replaces those
/// whenever they change: so its landing stays in its chart and near it, and is an upper bound of its distance to the surface. A vertex on a
/// curve lands on the edge that its curve becomes, and stays on the curve. Among equally near faces the lowest is taken.
/// Time: each collapse re-lands what its faces hold, so about (vertices / faces left) · (faces of a vertex)² nearest points.
class LandingTracker {
 public:
  explicit LandingTracker(const CollapseMesh& mesh);

  /// Around every collapse u→v of the mesh given to the constructor.
  void before(std::uint32_t u, const CollapseMesh::Edge& edge);
  void after();

  /// By vertex of the source; faces are those of the source. Vertices that are still there land on themselves, in their lowest face.
  [[nodiscard]] std::vector<Landing> landings() const;

 private:
  struct Moving {
    std::uint32_t vertex;
    int side;                                        // of u's curve
    std::uint32_t curve_a = kNone, curve_b = kNone;  // the edge of the curve that it belongs on
  };

  void take_faces(std::uint32_t u, const CollapseMesh::Edge& edge);
  void take_points(std::uint32_t face, int side);
  void land(const Moving& point);
  void land_on_edge(const Moving& point);
  void put(std::uint32_t vertex, const Landing& landing);
  [[nodiscard]] Vec3d place(std::uint32_t vertex) const { return to_double(mesh_.position(vertex)); }

  const CollapseMesh& mesh_;
  std::vector<Landing> landings_;           // by vertex of the source
  std::vector<std::uint32_t> head_;         // by face: first vertex that landed in it
  std::vector<std::uint32_t> next_;         // by vertex: the next one in its face
  std::vector<std::uint8_t> curve_corner_;  // by vertex: the side of its face that is its curve, where it is on one
  std::vector<Moving> moving_;
  std::array<std::vector<std::uint32_t>, 2> faces_;  // by side of u's curve: the faces that stay
  std::uint32_t target_ = kNone;
};

}  // namespace etalon::simplify
