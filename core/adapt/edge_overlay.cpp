#include "core/adapt/edge_overlay.h"

#include <algorithm>
#include <utility>

#include "core/mesh/exact_orientation.h"

namespace etalon::adapt {
namespace {

using Nodes = std::array<std::uint16_t, 2>;
using Piece = std::vector<std::uint16_t>;

class Overlay {
 public:
  Overlay(const EdgeRing& ring, std::span<const Vec2f> places)
      : count_(ring.size()), places_(places), triangles_(triangles_before(ring)), chords_(triangles_.size()) {}

  // False where the places do not allow an overlay.
  bool make() {
    if (!all_positive() || !locate()) return false;
    for (std::size_t k = 0; k < count_; ++k)
      if (!walk_to(static_cast<std::uint16_t>(kFirstRingNode + k))) return false;
    for (std::size_t t = 0; t < triangles_.size(); ++t) cut(t);
    return true;
  }

  [[nodiscard]] EdgeOverlay take() { return std::move(result_); }

 private:
  [[nodiscard]] int turn(std::uint16_t a, std::uint16_t b, std::uint16_t c) const {
    return orientation(places_[a], places_[b], places_[c]);
  }

  [[nodiscard]] bool all_positive() const {
    for (const auto& [a, b, c] : triangles_)
      if (turn(a, b, c) <= 0) return false;
    for (std::size_t k = 0; k < count_; ++k) {
      const auto here = static_cast<std::uint16_t>(kFirstRingNode + k),
                 next = static_cast<std::uint16_t>(kFirstRingNode + (k + 1) % count_);
      if (turn(kNodeW, here, next) <= 0) return false;
    }
    return true;
  }

  bool locate() {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const auto& [a, b, c] = triangles_[t];
      if (turn(a, b, kNodeW) <= 0 || turn(b, c, kNodeW) <= 0 || turn(c, a, kNodeW) <= 0) continue;
      holder_ = t, result_.holder = triangles_[t];
      const Vec2d pa(places_[a]), ab = Vec2d(places_[b]) - pa, ac = Vec2d(places_[c]) - pa, aw = Vec2d(places_[kNodeW]) - pa;
      const double area = detail::cross(ab, ac), y = detail::cross(aw, ac) / area, z = detail::cross(ab, aw) / area;
      result_.weights = {1 - y - z, y, z};
      return true;
    }
    return false;
  }

  // Along w–corner through the triangles before, from the one that holds w; a piece of it in each is a chord there.
  bool walk_to(std::uint16_t corner) {
    std::size_t t = holder_;
    std::uint16_t from = kNodeW;
    for (std::size_t steps = 0; steps <= triangles_.size(); ++steps) {
      const auto& triangle = triangles_[t];
      if (std::find(triangle.begin(), triangle.end(), corner) != triangle.end()) {
        chords_[t].push_back({from, corner});
        return true;
      }
      // Out where one end is on the right of the way and the other on its left.
      std::size_t out = 3;
      for (std::size_t k = 0; k < 3; ++k) {
        if (turn(kNodeW, corner, triangle[k]) < 0 && turn(kNodeW, corner, triangle[(k + 1) % 3]) > 0) out = k;
      }
      if (out == 3) return false;
      const Nodes edge{triangle[out], triangle[(out + 1) % 3]};
      const std::size_t beyond = triangle_with(edge[1], edge[0]);
      if (beyond == triangles_.size()) return false;
      const auto crossing = static_cast<std::uint16_t>(kFirstRingNode + count_ + result_.crossings.size());
      result_.crossings.push_back(
          {edge, corner,
           crossing_in_plane(Vec2d(places_[edge[0]]), Vec2d(places_[edge[1]]), Vec2d(places_[kNodeW]), Vec2d(places_[corner]))});
      chords_[t].push_back({from, crossing});
      from = crossing, t = beyond;
    }
    return false;
  }

  // The triangle that has the edge a→b; their number where there is none.
  [[nodiscard]] std::size_t triangle_with(std::uint16_t a, std::uint16_t b) const {
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        if (triangles_[t][k] == a && triangles_[t][(k + 1) % 3] == b) return t;
    return triangles_.size();
  }

  // The crossings on an edge from a to b: seen from w they turn one way.
  void append_edge(std::uint16_t a, std::uint16_t b, Piece& border) const {
    border.push_back(a);
    const std::size_t first = border.size();
    for (std::size_t n = 0; n < result_.crossings.size(); ++n) {
      const Nodes& edge = result_.crossings[n].edge;
      if ((edge[0] == a && edge[1] == b) || (edge[0] == b && edge[1] == a))
        border.push_back(static_cast<std::uint16_t>(kFirstRingNode + count_ + n));
    }
    const int way = turn(kNodeW, a, b);
    const auto corner_of = [&](std::uint16_t node) { return result_.crossings[node - kFirstRingNode - count_].corner; };
    std::sort(border.begin() + static_cast<std::ptrdiff_t>(first), border.end(),
              [&](std::uint16_t x, std::uint16_t y) { return x != y && turn(kNodeW, corner_of(x), corner_of(y)) == way; });
  }

  // A triangle along its chords.
  void cut(std::size_t t) {
    const auto& [a, b, c] = triangles_[t];
    Piece border;
    append_edge(a, b, border), append_edge(b, c, border), append_edge(c, a, border);
    if (t == holder_) return cut_around_w(border);
    std::vector<Piece> pieces{border};
    for (const Nodes& chord : chords_[t]) {
      for (std::size_t n = 0; n < pieces.size(); ++n) {
        const auto first = std::find(pieces[n].begin(), pieces[n].end(), chord[0]);
        const auto second = std::find(pieces[n].begin(), pieces[n].end(), chord[1]);
        if (first == pieces[n].end() || second == pieces[n].end()) continue;
        const auto low = std::min(first, second), high = std::max(first, second);
        Piece rest(pieces[n].begin(), low + 1);
        rest.insert(rest.end(), high, pieces[n].end());
        pieces[n] = Piece(low, high + 1);
        pieces.push_back(std::move(rest));
        break;
      }
    }
    for (Piece& piece : pieces) result_.pieces.push_back(std::move(piece));
  }

  // All chords of w's triangle begin at w.
  void cut_around_w(const Piece& border) {
    const auto is_end = [&](std::uint16_t node) {
      return std::any_of(chords_[holder_].begin(), chords_[holder_].end(), [&](const Nodes& chord) { return chord[1] == node; });
    };
    std::vector<std::size_t> ends;
    for (std::size_t n = 0; n < border.size(); ++n)
      if (is_end(border[n])) ends.push_back(n);
    for (std::size_t e = 0; e < ends.size(); ++e) {
      Piece piece{kNodeW};
      const std::size_t last = ends[(e + 1) % ends.size()];
      for (std::size_t n = ends[e];; n = (n + 1) % border.size()) {
        piece.push_back(border[n]);
        if (n == last) break;
      }
      result_.pieces.push_back(std::move(piece));
    }
  }

  std::size_t count_;
  std::span<const Vec2f> places_;
  std::vector<std::array<std::uint16_t, 3>> triangles_;
  std::vector<std::vector<Nodes>> chords_;  // by triangle
  std::size_t holder_ = 0;
  EdgeOverlay result_;
};

}  // namespace

std::optional<EdgeOverlay> overlay_edge_ring(const EdgeRing& ring, std::span<const Vec2f> places) {
  Overlay overlay(ring, places);
  if (!overlay.make()) return std::nullopt;
  return overlay.take();
}

}  // namespace etalon::adapt
