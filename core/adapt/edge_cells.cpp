#include "core/adapt/edge_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/adapt/edge_overlay.h"
#include "core/base/error.h"
#include "core/math/nearest_point.h"
#include "core/mesh/exact_orientation.h"

namespace etalon::adapt {
namespace {

Vec2d between(const Vec2f& from, const Vec2d& to, double share) { return Vec2d(from) + share * (to - Vec2d(from)); }

class EdgeCells {
 public:
  explicit EdgeCells(const EdgeRing& ring) : ring_(ring), before_(triangles_before(ring)) {
    nearest_u_ = nearest_after(ring.position_of_u), nearest_v_ = nearest_after(ring.position_of_v);
    nearest_w_ = nearest_before();
  }

  // Lays the edges over each other; false where the plane does not allow it.
  bool lay(OverlayPlane plane, double place_share) {
    u_after_ = Vec2f(between(ring_.uv_of_u, nearest_u_, place_share)), v_after_ = Vec2f(between(ring_.uv_of_v, nearest_v_, place_share));
    std::vector<Vec2f> places{u_after_, v_after_, ring_.uv_of_w};
    places.insert(places.end(), ring_.uv.begin(), ring_.uv.end());
    if (plane == OverlayPlane::edge_space) project(places);
    auto overlay = overlay_edge_ring(ring_, places);
    if (!overlay) return false;
    overlay_ = std::move(*overlay);
    nearest_.clear();
    for (const EdgeOverlay::Crossing& c : overlay_.crossings)
      nearest_.push_back(
          nearest_in_space(position(c.edge[0]), position(c.edge[1]), ring_.position_of_w, position(c.corner)).value_or(c.at));
    return true;
  }

  // Places all nodes and cuts the pieces into triangles; false where one is not positive.
  bool place(double share, RingCells& result) const {
    result.nodes.clear(), result.cells.clear();
    result.nodes.push_back({ring_.uv_of_u, u_after_});
    result.nodes.push_back({ring_.uv_of_v, v_after_});
    Vec2d held(0, 0);  // where the overlay has w, in the texture before
    for (int k = 0; k < 3; ++k) held = held + overlay_.weights[k] * Vec2d(uv_before(overlay_.holder[static_cast<std::size_t>(k)]));
    result.nodes.push_back({Vec2f(held + share * (nearest_w_ - held)), ring_.uv_of_w});
    for (const Vec2f& uv : ring_.uv) result.nodes.push_back({uv, uv});
    for (std::size_t n = 0; n < nearest_.size(); ++n) {
      const EdgeOverlay::Crossing& c = overlay_.crossings[n];
      const double first = c.at.first + share * (nearest_[n].first - c.at.first);
      const double second = c.at.second + share * (nearest_[n].second - c.at.second);
      result.nodes.push_back({Vec2f(between(uv_before(c.edge[0]), Vec2d(uv_before(c.edge[1])), first)),
                              Vec2f(between(ring_.uv_of_w, Vec2d(uv_before(c.corner)), second))});
    }
    return std::all_of(overlay_.pieces.begin(), overlay_.pieces.end(),
                       [&](const auto& piece) { return triangulate(piece, 0, piece.size() - 1, result); });
  }

 private:
  [[nodiscard]] const Vec3f& position(std::uint16_t node) const {
    return node == kNodeU ? ring_.position_of_u : node == kNodeV ? ring_.position_of_v : ring_.positions[node - kFirstRingNode];
  }
  [[nodiscard]] const Vec2f& uv_before(std::uint16_t node) const {
    return node == kNodeU ? ring_.uv_of_u : node == kNodeV ? ring_.uv_of_v : ring_.uv[node - kFirstRingNode];
  }

  // The texture coordinate of the point of some triangles nearest to p; ties go to the first.
  template <class ForEach>
  [[nodiscard]] static Vec2d nearest_on(const Vec3f& p, const ForEach& for_each) {
    NearestOnTriangle best;
    Vec2d uv(0, 0);
    bool any = false;
    for_each([&](const std::array<const Vec3f*, 3>& at, const std::array<const Vec2f*, 3>& corner) {
      const NearestOnTriangle here = nearest_on_triangle(to_double(p), to_double(*at[0]), to_double(*at[1]), to_double(*at[2]));
      if (any && here.distance2 >= best.distance2) return;
      best = here, any = true;
      const Vec2d a(*corner[0]);
      uv = a + here.weights.y * (Vec2d(*corner[1]) - a) + here.weights.z * (Vec2d(*corner[2]) - a);
    });
    return uv;
  }

  [[nodiscard]] Vec2d nearest_after(const Vec3f& p) const {
    return nearest_on(p, [&](const auto& visit) {
      for (std::size_t k = 0; k < ring_.size(); ++k) {
        const std::size_t l = (k + 1) % ring_.size();
        visit({&ring_.position_of_w, &ring_.positions[k], &ring_.positions[l]}, {&ring_.uv_of_w, &ring_.uv[k], &ring_.uv[l]});
      }
    });
  }

  [[nodiscard]] Vec2d nearest_before() const {
    return nearest_on(ring_.position_of_w, [&](const auto& visit) {
      for (const auto& [a, b, c] : before_)
        visit({&position(a), &position(b), &position(c)}, {&uv_before(a), &uv_before(b), &uv_before(c)});
    });
  }

  // Along the ring's area vector; coordinates in units of a diameter, so that float32 holds them as well as texture coordinates.
  void project(std::vector<Vec2f>& places) const {
    Vec3d normal(0, 0, 0), far(0, 0, 0);
    for (std::size_t k = 0; k < ring_.size(); ++k) {
      const Vec3d here = difference_of(ring_.positions[0], ring_.positions[k]);
      normal = normal + cross_product(here, difference_of(ring_.positions[0], ring_.positions[(k + 1) % ring_.size()]));
      if (dot_product(here, here) > dot_product(far, far)) far = here;
    }
    const double length2 = dot_product(normal, normal);
    const Vec3d x = far - (dot_product(far, normal) / length2) * normal, y = cross_product(normal, x);
    const double unit_x = dot_product(x, x), unit_y = std::sqrt(length2) * unit_x;
    const auto projected = [&](const Vec3f& p) {
      const Vec3d d = difference_of(ring_.positions[0], p);
      const Vec2f at(static_cast<float>(dot_product(d, x) / unit_x), static_cast<float>(dot_product(d, y) / unit_y));
      return std::isfinite(at.x) && std::isfinite(at.y) ? at : Vec2f{0, 0};  // no plane: then nothing is counter-clockwise
    };
    places = {projected(ring_.position_of_u), projected(ring_.position_of_v), projected(ring_.position_of_w)};
    for (const Vec3f& p : ring_.positions) places.push_back(projected(p));
  }

  static bool is_positive(const RingCells& cells, const std::array<std::uint16_t, 3>& cell) {
    const CellNode &a = cells.nodes[cell[0]], &b = cells.nodes[cell[1]], &c = cells.nodes[cell[2]];
    return orientation(a.before, b.before, c.before) > 0 && orientation(a.after, b.after, c.after) > 0;
  }

  // Corners first..last of a piece: the triangle on its closing side, then what is left on both sides of that.
  static bool triangulate(const std::vector<std::uint16_t>& piece, std::size_t first, std::size_t last, RingCells& result) {
    if (last - first < 2) return true;
    const std::size_t kept = result.cells.size();
    for (std::size_t top = first + 1; top < last; ++top) {
      const std::array<std::uint16_t, 3> cell{piece[first], piece[top], piece[last]};
      if (is_positive(result, cell)) {
        result.cells.push_back(cell);
        if (triangulate(piece, first, top, result) && triangulate(piece, top, last, result)) return true;
        result.cells.resize(kept);
      }
    }
    return false;
  }

  const EdgeRing& ring_;
  std::vector<std::array<std::uint16_t, 3>> before_;
  Vec2d nearest_u_{0, 0}, nearest_v_{0, 0}, nearest_w_{0, 0};
  Vec2f u_after_{0, 0}, v_after_{0, 0};
  EdgeOverlay overlay_;
  std::vector<CrossingParameters> nearest_;  // by crossing
};

// False for a ring that is too large.
bool require_ring(const EdgeRing& ring) {
  const std::size_t n = ring.size();
  if (n < 3 || ring.positions.size() != n || ring.last_of_u < 1 || ring.last_of_u >= n)
    throw InputError(
        fmt::format("ring of an edge: expected at least 3 corners with a position each, got {} and {}, and 1 to {} as u's last, got {}", n,
                    ring.positions.size(), n - 1, ring.last_of_u));
  if (!is_unfolded(ring)) throw InputError("ring of an edge: expected counter-clockwise triangles, got a fold");
  return n <= kMostEdgeCorners;
}

bool try_share(const EdgeCells& edge, const EdgeChoice& choice, RingCells& result) {
  if (!edge.place(choice.crossing_share, result)) return false;
  result.u_kept = choice.place_share, result.crossings_kept = choice.crossing_share, result.plane = choice.plane;
  return true;
}

}  // namespace

std::optional<RingCells> make_edge_cells(const EdgeRing& ring) {
  if (!require_ring(ring)) return std::nullopt;
  EdgeCells edge(ring);
  RingCells result;
  if (edge.lay(OverlayPlane::edge_space, 1) && try_share(edge, {OverlayPlane::edge_space, 1, 1}, result)) return result;
  for (const double place_share : kPlaceShares) {
    if (!edge.lay(OverlayPlane::edge_texture_after, place_share)) continue;
    for (const double share : kCrossingShares)
      if (try_share(edge, {OverlayPlane::edge_texture_after, place_share, share}, result)) return result;
  }
  return std::nullopt;
}

std::optional<RingCells> edge_cells_at(const EdgeRing& ring, const EdgeChoice& choice) {
  ETALON_CHECK(choice.plane != OverlayPlane::texture_after, "cells of an edge: the plane of a half-edge collapse");
  if (!require_ring(ring)) return std::nullopt;
  EdgeCells edge(ring);
  RingCells result;
  if (!edge.lay(choice.plane, choice.place_share) || !try_share(edge, choice, result)) return std::nullopt;
  return result;
}

}  // namespace etalon::adapt
