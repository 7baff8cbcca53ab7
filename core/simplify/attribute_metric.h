// What the metrics of position and attributes have in common: one quadric for each place at which attributes are stored.
#pragma once

#include <algorithm>
#include <span>
#include <utility>

#include "core/simplify/collapse_candidate.h"
#include "core/simplify/curve_planes.h"
#include "core/simplify/moved_vertex.h"
#include "core/simplify/placement.h"

namespace etalon::simplify {

/// Attributes:
///   kCount; kPerWedge (else per vertex); array<float, kCount> value(mesh, node) of a vertex or wedge; float stored(double), rounded and in
/// range;
///   adopt(left, right, moved).
/// Quadric<Real, M>: AttributeQuadric or HoppeQuadric.
///
/// State: one quadric of float32 a node, measured from the node's own point in the unit cube, rounded once a collapse; all arithmetic in
/// double. Per
/// wedge, a seam vertex costs the sum over its wedges: a collapse joins the wedges of each side.
template <template <class, std::size_t> class Quadric, class Attributes>
class AttributeMetric {
 public:
  static constexpr bool kCostsAreLocal = true;
  static constexpr std::size_t kCount = Attributes::kCount;
  using Stored = Quadric<float, kCount>;
  using Merged = Quadric<double, kCount>;

  /// `weight`: of a difference of 1 in an attribute beside the longest side of the model's box (Garland's unit cube).
  AttributeMetric(const CollapseMesh& mesh, const UnitPositions& positions, const QemOptions& options, double weight)
      : mesh_(mesh), places_(positions.at), scale_(weight * positions.longest) {
    quadrics_.resize(Attributes::kPerWedge ? mesh.source().wedge_count() : mesh.vertex_capacity());
    // Faces of one vertex and one node follow each other around it; a node met again goes on from its rounded state.
    for (std::uint32_t u = 0; u < mesh.vertex_capacity(); ++u) {
      if (!mesh.vertex_alive(u)) continue;
      Merged q;
      std::uint32_t node = kNone;
      const auto finish = [&] {
        if (node != kNone) quadrics_[node] = rounded(moved_sum(q, quadrics_[node], AttributeStep<kCount>{}));
        q = {};
      };
      for_each_corner(mesh, u, [&](std::uint32_t h) {
        if (const std::uint32_t here = node_at(h); here != node) {
          finish();
          node = here;
        }
        const FaceSides sides = face_sides(mesh, positions, h);
        const auto side = [&](const Vec3d& d, std::uint32_t at) { return step_of<kCount>(d, attribute_step(node, node_at(at))); };
        if (sides.doubled_area > 0)
          add_triangle_at_origin(q, side(sides.out, CollapseMesh::next(h)), side(sides.in, CollapseMesh::previous(h)),
                                 0.5 * sides.doubled_area);
        for_each_curve_plane(mesh, h, sides, options, [&](const Vec3d& n, double plane) { add_plane_at_origin(q, n, plane); });
      });
      finish();
    }
  }

  /// The merged quadrics of all sides at v, and what v's other wedges cost where they are.
  [[nodiscard]] double cost(std::uint32_t u, std::uint32_t v, std::uint32_t h) const {
    double sum = own_cost(v);
    for (const auto& [from, to] : sides(u, v, h)) sum += evaluate(quadrics_[from], step(u, from, v, to));
    return sum > 0 ? sum : 0;
  }
  void costs(std::uint32_t u, std::span<CollapseCandidate> candidates) const {
    for (CollapseCandidate& candidate : candidates) candidate.cost = cost(u, candidate.target, candidate.half_edge);
  }
  /// A cost as a squared length in the unit cube's space of positions and attributes.
  [[nodiscard]] double squared_distance(std::uint32_t u, std::uint32_t v, double cost) const {
    double weight = 0;
    for_each_node(u, [&](std::uint32_t node) { weight += total_weight(quadrics_[node]); });
    for_each_node(v, [&](std::uint32_t node) { weight += total_weight(quadrics_[node]); });
    return weight > 0 ? cost / weight : 0;
  }
  /// The sides of v take over those of u; no node's own error falls, whatever the rounding of a sum that is about 0.
  void collapse(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge) {
    for (const auto& [from, to] : sides(u, v, edge.left != kNone ? edge.left : edge.right)) {
      const float own = constant(quadrics_[to]);
      quadrics_[to] = rounded(moved_sum(quadrics_[to], quadrics_[from], step(u, from, v, to)));
      constant(quadrics_[to]) = std::max(constant(quadrics_[to]), own);
    }
  }

  [[nodiscard]] Placement place(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge) const {
    const Sides pairs = sides(u, v, edge.left != kNone ? edge.left : edge.right);
    std::array<Merged, kMaxSides> merged;
    std::array<AttributeStep<kCount>, kMaxSides> to_u;
    for (std::size_t i = 0; i < pairs.count; ++i) {
      const auto& [from, to] = pairs.of[i];
      merged[i] = moved_sum(quadrics_[to], quadrics_[from], step(u, from, v, to));
      to_u[i] = step(v, to, u, from);
    }
    const std::span<const Merged> all(merged.data(), pairs.count);
    return place_vertex(places_[v], places_[u], all, std::span<const AttributeStep<kCount>>(to_u.data(), pairs.count),
                        [&](std::size_t side, const std::array<double, kCount>& wanted, std::array<float, 3>& stored) {
                          const auto old = Attributes::value(mesh_, pairs.of[side].second);
                          std::array<double, kCount> difference{};
                          for (std::size_t j = 0; j < kCount; ++j) {
                            stored[j] = Attributes::stored(old[j] + wanted[j] / scale_);
                            difference[j] = (static_cast<double>(stored[j]) - old[j]) * scale_;
                          }
                          return difference;
                        });
  }
  /// Before v moves: joins the sides, each measured from v's new point.
  void merge(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge, const Placement& placement) {
    const Sides pairs = sides(u, v, edge.left != kNone ? edge.left : edge.right);
    for (std::size_t i = 0; i < pairs.count; ++i) {
      const auto& [from, to] = pairs.of[i];
      const Merged merged = moved_sum(quadrics_[to], quadrics_[from], step(u, from, v, to));
      const auto old = Attributes::value(mesh_, to);
      std::array<double, kCount> difference{};
      for (std::size_t j = 0; j < kCount; ++j) difference[j] = (static_cast<double>(placement.attributes[i][j]) - old[j]) * scale_;
      quadrics_[to] = rounded(moved_sum(Merged{}, merged, step_of<kCount>(difference_of(places_[v], placement.at), difference)));
    }
  }
  /// Overwrites what place() chose.
  void adopt(const Placement& placement, std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge, MovedVertex& moved) const {
    const Sides pairs = sides(u, v, edge.left != kNone ? edge.left : edge.right);
    Attributes::adopt(placement.attributes[0], placement.attributes[pairs.count - 1], moved);
  }

  [[nodiscard]] std::size_t state_bytes() const { return quadrics_.size() * sizeof(Stored); }

 private:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  struct Sides {
    std::array<Pair, kMaxSides> of;
    std::size_t count = 0;
    [[nodiscard]] const Pair* begin() const { return of.data(); }
    [[nodiscard]] const Pair* end() const { return of.data() + count; }
  };

  [[nodiscard]] std::uint32_t node_at(std::uint32_t h) const { return Attributes::kPerWedge ? mesh_.wedge(h) : mesh_.start(h); }

  /// Nodes of u and of v that meet: left of the edge, then right of it where that is another pair.
  [[nodiscard]] Sides sides(std::uint32_t u, std::uint32_t v, std::uint32_t h) const {
    Sides result;
    if constexpr (!Attributes::kPerWedge) {
      result.of[0] = {u, v};
      result.count = 1;
    } else {
      const CollapseMesh::Edge edge = mesh_.edge_from(u, h);
      if (edge.left != kNone) result.of[result.count++] = {mesh_.wedge(edge.left), mesh_.wedge(CollapseMesh::next(edge.left))};
      if (edge.right != kNone) {
        const Pair right{mesh_.wedge(CollapseMesh::next(edge.right)), mesh_.wedge(edge.right)};
        if (result.count == 0 || result.of[0] != right) result.of[result.count++] = right;
      }
    }
    return result;
  }

  template <class Visit>
  void for_each_node(std::uint32_t v, const Visit& visit) const {
    if constexpr (!Attributes::kPerWedge) {
      visit(v);
    } else if (mesh_.kind(v) == VertexKind::interior) {
      visit(mesh_.wedge(mesh_.first_out(v)));
    } else {
      // Each run of corners once, a closed fan's first run at its end where the last corner continues it.
      std::uint32_t last = kNone, first = kNone, runs = 0;
      for_each_corner(mesh_, v, [&](std::uint32_t h) {
        const std::uint32_t node = mesh_.wedge(h);
        if (node == last) return;
        if (first == kNone) first = node;
        if (runs++ > 0) visit(node);
        last = node;
      });
      if (runs == 1 || last != first || mesh_.on_boundary(v)) visit(first);
    }
  }

  [[nodiscard]] double own_cost(std::uint32_t v) const {
    double sum = 0;
    for_each_node(v, [&](std::uint32_t node) { sum += constant(quadrics_[node]); });
    return sum;
  }
  // What a node costs where it is.
  template <class Q>
  static auto& constant(Q& q) {
    if constexpr (requires { q.space; })
      return q.space.c;
    else
      return q.c;
  }

  [[nodiscard]] std::array<double, kCount> attribute_step(std::uint32_t from, std::uint32_t to) const {
    const auto a = Attributes::value(mesh_, from), b = Attributes::value(mesh_, to);
    std::array<double, kCount> result{};
    for (std::size_t j = 0; j < kCount; ++j) result[j] = (static_cast<double>(b[j]) - a[j]) * scale_;
    return result;
  }
  [[nodiscard]] AttributeStep<kCount> step(std::uint32_t from_vertex, std::uint32_t from, std::uint32_t to_vertex, std::uint32_t to) const {
    return step_of<kCount>(difference_of(places_[from_vertex], places_[to_vertex]), attribute_step(from, to));
  }

  const CollapseMesh& mesh_;
  const std::vector<Vec3f>& places_;
  double scale_;
  std::vector<Stored> quadrics_;
};

/// Vertex colours, RGB in [0, 1].
struct ColorAttributes {
  static constexpr std::size_t kCount = 3;
  static constexpr bool kPerWedge = false;
  static std::array<float, 3> value(const CollapseMesh& mesh, std::uint32_t v) {
    const Vec4f& color = mesh.color(v);
    return {color.x, color.y, color.z};
  }
  static float stored(double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); }
  static void adopt(const std::array<float, 3>& rgb, const std::array<float, 3>&, MovedVertex& moved) {
    moved.color = {rgb[0], rgb[1], rgb[2], moved.color.w};
  }
};

/// Texture coordinates of wedges, v up.
struct UvAttributes {
  static constexpr std::size_t kCount = 2;
  static constexpr bool kPerWedge = true;
  static std::array<float, 2> value(const CollapseMesh& mesh, std::uint32_t wedge) {
    const Vec2f& uv = mesh.uv_of_wedge(wedge);
    return {uv.x, uv.y};
  }
  static float stored(double value) { return static_cast<float>(value); }
  // With one pair both are that of all; with one side of a boundary likewise.
  static void adopt(const std::array<float, 3>& first, const std::array<float, 3>& last, MovedVertex& moved) {
    moved.uv = {Vec2f{first[0], first[1]}, Vec2f{last[0], last[1]}};
  }
};

}  // namespace etalon::simplify
