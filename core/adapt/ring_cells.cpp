#include "core/adapt/ring_cells.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/adapt/crossing_parameters.h"
#include "core/base/error.h"
#include "core/mesh/exact_orientation.h"

namespace etalon::adapt {
namespace {

constexpr std::size_t kMostCorners = 16'000, kMostNodes = 65'535;

// A crossing of the spoke u–k and the diagonal v–j: of the overlay (in the texture plane, from u's new place), and of the nearest points in space.
struct Crossing {
  std::size_t k, j;
  CrossingParameters overlay, nearest;
};

// The overlay's combinatorics for a place of u that sees the whole ring. Everything follows from the triangle (0, t, t + 1) that holds it:
// the diagonal 0–j parts the corners below j from those above, so the spoke to k crosses it exactly where u and k are on different sides.
class Overlay {
 public:
  Overlay(const CollapseRing& ring, const Vec2f& place) : ring_(ring), place_(place) {}

  // False where the place does not see the whole ring.
  bool locate() {
    const std::size_t n = ring_.size();
    for (std::size_t k = 0; k < ring_.triangles_before(); ++k)
      if (orientation(place_, ring_.uv[k], ring_.uv[(k + 1) % n]) <= 0) return false;
    triangle_ = n - 2, on_diagonal_ = false;
    if (ring_.on_curve) return true;  // on the last triangle's edge, up to rounding
    const auto left_of = [&](std::size_t j) { return orientation(ring_.uv[0], ring_.uv[j], place_); };
    for (std::size_t t = 1; t + 1 < n; ++t) {
      if (left_of(t) < 0 || left_of(t + 1) >= 0 || orientation(ring_.uv[t], ring_.uv[t + 1], place_) <= 0) continue;
      triangle_ = t, on_diagonal_ = t >= 2 && left_of(t) == 0;
      return true;
    }
    return false;
  }

  // False where there would be more nodes than cells can name.
  bool find_crossings() {
    const std::size_t n = ring_.size();
    const std::size_t below = triangle_ - (on_diagonal_ ? 1 : 0);  // diagonals 2..below are below u, triangle_+1..n−2 above
    const std::size_t above = n - 1 - triangle_;
    if (1 + n + below * (below - 1) / 2 + above * (above - 1) / 2 > kMostNodes) return false;
    crossing_of_.assign(n * n, 0), crossings_.clear();
    for (std::size_t j = 2; j <= below; ++j)
      for (std::size_t k = 1; k < j; ++k) add(k, j);
    for (std::size_t j = triangle_ + 1; j + 2 <= n; ++j)
      for (std::size_t k = j + 1; k < n; ++k) add(k, j);
    return true;
  }

  [[nodiscard]] const std::vector<Crossing>& crossings() const { return crossings_; }

  // The convex pieces, three or four nodes each, counter-clockwise. Between the spokes k and k + 1 the diagonals run from one to the other.
  template <class Piece>
  void for_pieces(const Piece& piece) const {
    const std::size_t n = ring_.size(), below = triangle_ - (on_diagonal_ ? 1 : 0);
    for (std::size_t k = 0; k < ring_.triangles_before(); ++k) {
      const std::size_t l = k + 1;
      if (k < triangle_ && below >= std::max<std::size_t>(l, 2)) {  // all diagonals here come from below u: j = below … max(l, 2)
        piece({0, node(k, below), node(l, below)});
        const std::size_t last = std::max<std::size_t>(l, 2);
        for (std::size_t j = below; j > last; --j) piece({node(k, j), node(k, j - 1), node(l, j - 1), node(l, j)});
        piece({node(k, last), node(k, k), node(l, l), node(l, last)});
      } else if (k > triangle_ && triangle_ + 1 <= std::min(k, n - 2)) {
        const std::size_t first = triangle_ + 1, last = std::min(k, n - 2);
        piece({0, node(k, first), node(l, first)});
        for (std::size_t j = first; j < last; ++j) piece({node(k, j), node(k, j + 1), node(l, j + 1), node(l, j)});
        piece({node(k, last), node(k, k), node(l, l), node(l, last)});
      } else {
        piece({0, node(k, k), node(l, l)});
      }
    }
  }

 private:
  void add(std::size_t k, std::size_t j) {
    crossing_of_[k * ring_.size() + j] = static_cast<std::uint16_t>(1 + ring_.size() + crossings_.size());
    crossings_.push_back({k, j, in_texture(k, j), in_space(k, j)});
  }

  // The node where the diagonal j meets the spoke k: their crossing, or the corner they share.
  [[nodiscard]] std::uint16_t node(std::size_t k, std::size_t j) const {
    const std::size_t n = ring_.size();
    if (k == 0 || k == n) return 1;
    return k == j ? static_cast<std::uint16_t>(1 + k) : crossing_of_[k * n + j];
  }

  [[nodiscard]] CrossingParameters in_texture(std::size_t k, std::size_t j) const {
    return crossing_in_plane(Vec2d(place_), Vec2d(ring_.uv[k]), Vec2d(ring_.uv[0]), Vec2d(ring_.uv[j]));
  }

  // The nearest points of the edge u–k before and the edge v–j after. Those of the texture plane where there are none between the ends.
  [[nodiscard]] CrossingParameters in_space(std::size_t k, std::size_t j) const {
    const auto nearest = nearest_in_space(ring_.position_of_u, ring_.positions[k], ring_.positions[0], ring_.positions[j]);
    return nearest ? *nearest : in_texture(k, j);
  }

  const CollapseRing& ring_;
  Vec2f place_;
  std::size_t triangle_ = 0;  // u is in (0, t, t + 1)
  bool on_diagonal_ = false;  // and on its side 0–t
  std::vector<Crossing> crossings_;
  std::vector<std::uint16_t> crossing_of_;  // node by spoke and diagonal
};

std::vector<CellNode> place_nodes(const CollapseRing& ring, const Vec2f& place, const std::vector<Crossing>& crossings, double share) {
  std::vector<CellNode> nodes = {{ring.uv_of_u, place}};
  for (const Vec2f& uv : ring.uv) nodes.push_back({uv, uv});
  nodes[1].before = ring.target_before();
  const auto along = [](const Vec2f& from, const Vec2f& to, double t) { return Vec2f(Vec2d(from) + t * (Vec2d(to) - Vec2d(from))); };
  for (const Crossing& c : crossings) {
    const double spoke = c.overlay.first + share * (c.nearest.first - c.overlay.first);
    const double diagonal = c.overlay.second + share * (c.nearest.second - c.overlay.second);
    nodes.push_back({along(ring.uv_of_u, ring.uv[c.k], spoke), along(ring.uv[0], ring.uv[c.j], diagonal)});
  }
  return nodes;
}

// Triangles of the pieces, positive before and after; a quadrilateral along the first of its diagonals that allows it. False where none does.
bool triangulate(const Overlay& overlay, RingCells& result) {
  result.cells.clear();
  bool positive = true;
  const auto is_positive = [&](const std::array<std::uint16_t, 3>& cell) {
    const CellNode &a = result.nodes[cell[0]], &b = result.nodes[cell[1]], &c = result.nodes[cell[2]];
    return orientation(a.before, b.before, c.before) > 0 && orientation(a.after, b.after, c.after) > 0;
  };
  overlay.for_pieces([&](std::initializer_list<std::uint16_t> corners) {
    std::array<std::uint16_t, 4> p{};
    std::size_t count = 0;  // without repeated corners: at v the strips are triangles
    for (const std::uint16_t corner : corners)
      if (count == 0 || corner != p[count - 1]) p[count++] = corner;
    if (count > 1 && p[count - 1] == p[0]) --count;
    if (count < 3) return;
    const auto try_cells = [&](std::initializer_list<std::array<std::uint16_t, 3>> cells) {
      if (!std::all_of(cells.begin(), cells.end(), is_positive)) return false;
      result.cells.insert(result.cells.end(), cells);
      return true;
    };
    if (count == 3) {
      positive &= try_cells({{p[0], p[1], p[2]}});
    } else {
      positive = positive && (try_cells({{p[0], p[1], p[2]}, {p[0], p[2], p[3]}}) || try_cells({{p[1], p[2], p[3]}, {p[1], p[3], p[0]}}));
    }
  });
  return positive;
}

// False for a ring of two corners, which has no cells.
bool require_ring(const CollapseRing& ring) {
  const std::size_t n = ring.size();
  if (n < 3 || n > kMostCorners || ring.positions.size() != n) {
    if (ring.on_curve && n == 2 && ring.positions.size() == n) return false;
    throw InputError(fmt::format("ring of a collapse: expected 3 to {} corners with a position each, got {} and {}", kMostCorners, n,
                                 ring.positions.size()));
  }
  if (!is_unfolded(ring)) throw InputError("ring of a collapse: expected counter-clockwise triangles, got a fold");
  return true;
}

}  // namespace

std::optional<RingCells> make_ring_cells(const CollapseRing& ring) {
  if (!require_ring(ring)) return std::nullopt;
  const Vec2d from(ring.uv_of_u), way = new_place_of_u(ring) - from;
  RingCells result;
  for (const double u_share : kPlaceShares) {
    if (ring.on_curve && u_share != 1) break;  // the curve's new edge is where u goes, and the other side's u too
    const Vec2f place(from + u_share * way);
    Overlay overlay(ring, place);
    if (!overlay.locate()) continue;
    if (!overlay.find_crossings()) return std::nullopt;
    result.u_kept = u_share;
    for (const double share : kCrossingShares) {
      result.crossings_kept = share;
      result.nodes = place_nodes(ring, place, overlay.crossings(), share);
      if (triangulate(overlay, result)) return result;
    }
  }
  return std::nullopt;
}

std::optional<RingCells> ring_cells_at(const CollapseRing& ring, const Vec2f& place, double u_share, double crossing_share) {
  if (!require_ring(ring)) return std::nullopt;
  Overlay overlay(ring, place);
  if (!overlay.locate() || !overlay.find_crossings()) return std::nullopt;
  RingCells result{.nodes = place_nodes(ring, place, overlay.crossings(), crossing_share),
                   .cells = {},
                   .u_kept = u_share,
                   .crossings_kept = crossing_share};
  if (!triangulate(overlay, result)) return std::nullopt;
  return result;
}

}  // namespace etalon::adapt
