// Follows every vertex of the input over the surface while it is simplified.
#pragma once

#include <array>

#include "core/mesh/landing.h"
#include "core/simplify/collapse_mesh.h"

namespace etalon::simplify {

/// A vertex lands, when it is removed or moved, on the nearest point of the faces that replace its own, and goes on to the nearest point of
/// what replaces
/// those whenever they change: so its landing stays in its chart and near it, and is an upper bound of its distance to the surface. A
/// vertex on
/// a curve lands on an edge that its curve becomes, and stays on the curve. Among equally near faces the lowest is taken.
/// Time: each collapse re-lands what its faces hold, so about (vertices / faces left) · (faces of a vertex)² nearest points.
class LandingTracker {
 public:
  explicit LandingTracker(const CollapseMesh& mesh);

  /// The collapse u→v that may come next; `at`: where v goes (model units), or nothing where it stays. Changes no landing.
  void plan(std::uint32_t u, const CollapseMesh::Edge& edge, const Vec3f* at = nullptr);
  /// Whether, after the planned collapse, every landing that it changes is within `distance` (≥ 0, model units) of its vertex, and that by
  /// more than
  /// its rounding: 2^-48 of the model's largest coordinate.
  [[nodiscard]] bool planned_within(double distance) const;
  /// Around the planned collapse: before() it is done, and after().
  void before();
  void after();

  /// By vertex of the source; faces are those of the source. Vertices that never moved and are still there land on themselves, in their
  /// lowest face.
  [[nodiscard]] std::vector<Landing> landings() const;

 private:
  struct Moving {
    std::uint32_t vertex;
    int side;                                        // of u's curve
    std::uint32_t curve_a = kNone, curve_b = kNone;  // the edge of the curve that it belongs on,
    bool on_chain = false;                           // or the two that v has afterwards
  };

  void take_faces(std::uint32_t w, std::uint32_t first, int side);
  void take_points(std::uint32_t face, int side);
  void take_self(std::uint32_t w, int side);
  void plan_curve(std::uint32_t u, bool moves);
  void land_on_edge(const Moving& point);
  void put(std::uint32_t vertex, const Landing& landing);
  [[nodiscard]] NearestOnTriangle nearest(const Moving& point, std::uint32_t& face) const;
  // After the planned collapse.
  [[nodiscard]] Vec3d corner(std::uint32_t v) const { return v == u_ || v == v_ ? at_ : to_double(mesh_.position(v)); }
  [[nodiscard]] Vec3d input(std::uint32_t vertex) const { return to_double(mesh_.source().positions[vertex]); }

  const CollapseMesh& mesh_;
  std::vector<Landing> landings_;           // by vertex of the source
  std::vector<std::uint32_t> head_;         // by face: first vertex that landed in it
  std::vector<std::uint32_t> next_;         // by vertex: the next one in its face
  std::vector<std::uint8_t> curve_corner_;  // by vertex: the side of its face that is its curve, where it is on one
  std::vector<bool> followed_;              // by vertex: whether it has landed
  double slack_ = 0;

  std::uint32_t u_ = kNone, v_ = kNone;
  bool moves_ = false;
  CollapseMesh::Edge edge_;
  Vec3d at_{0, 0, 0};
  std::vector<Moving> moving_;
  std::array<std::vector<std::uint32_t>, 2> faces_;  // by side of the curve: the faces that stay
  std::vector<std::uint32_t> emptied_;               // all faces whose points move
  std::vector<std::uint32_t> chain_;                 // v's neighbours on the curve afterwards
};

}  // namespace etalon::simplify
