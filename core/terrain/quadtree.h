// The 4-8 hierarchy of a (2^k+1)² grid: right-angled triangles, each split from its right angle to the middle of its longest side; the quadtree
// meshes of [Balmelli, Ayer & Vetterli 1998], also known as right-triangulated irregular networks [Evans, Kirkpatrick & Townsend 2001].
// Everything follows from a point's two indices; nothing is stored.
//
// Every grid point but the four corners splits one edge, the longest side of the one or two triangles beside it. Levels alternate: points of
// even level 2(k−1−t) are middles of squares of side 2h, h = 2^t, and split a diagonal; points of odd level are middles of sides of length 2h.
// A point can be there only with its parents, the right angles of the two triangles that it splits; the points which need it are its children.
// Its merging domain is itself with all descendants; parents are one level above, so levels 0, 1, 2 … are a topological order.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace etalon::terrain {

struct GridPoint {
  int i = 0, j = 0;
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

/// How a grid point splits its edge, which runs from p − along to p + along; the parents are p − across and p + across, |along| = |across|.
struct Split {
  int level = -1;  ///< 0..2k−1; −1 for the four corners, which split nothing and are always there
  GridPoint along, across;
};

[[nodiscard]] inline Split split_of(int bits, GridPoint p) {
  const auto steps = 1u << bits;
  const int ti = std::countr_zero(static_cast<unsigned>(p.i) | steps), tj = std::countr_zero(static_cast<unsigned>(p.j) | steps);
  const int t = ti < tj ? ti : tj;
  if (t >= bits) return {};
  const int h = 1 << t, level = 2 * (bits - 1 - t);
  if (ti < tj) return {level + 1, {h, 0}, {0, h}};
  if (tj < ti) return {level + 1, {0, h}, {h, 0}};
  // The square's diagonal runs between its corners of even sum, of which one is the middle and one a corner of the square around.
  if ((((p.i >> (t + 1)) + (p.j >> (t + 1))) & 1) == 0) return {level, {h, h}, {h, -h}};
  return {level, {h, -h}, {h, h}};
}

[[nodiscard]] inline bool inside(int bits, GridPoint p) {
  const int steps = 1 << bits;
  return p.i >= 0 && p.j >= 0 && p.i <= steps && p.j <= steps;
}

[[nodiscard]] inline std::uint32_t point_index(int bits, GridPoint p) {
  return static_cast<std::uint32_t>(p.j) * ((1u << bits) + 1) + static_cast<std::uint32_t>(p.i);
}
[[nodiscard]] inline GridPoint point_at(int bits, std::uint32_t index) {
  const std::uint32_t side = (1u << bits) + 1;
  return {static_cast<int>(index % side), static_cast<int>(index / side)};
}

/// The parents inside the grid: two, or one for a point on the grid's border; corners among them.
template <class Body>
void for_each_parent(int bits, GridPoint p, const Split& split, const Body& body) {
  const GridPoint parents[2] = {{p.i - split.across.i, p.j - split.across.j}, {p.i + split.across.i, p.j + split.across.j}};
  for (const GridPoint& parent : parents)
    if (inside(bits, parent)) body(parent);
}

/// The points that need p, up to four, all of the next level; p is no corner.
template <class Body>
void for_each_child(int bits, GridPoint p, const Split& split, const Body& body) {
  const bool is_middle = split.level % 2 == 0;
  const int h = split.along.i != 0 ? split.along.i : split.along.j;
  if (is_middle) {
    for (const GridPoint& d : {GridPoint{-h, 0}, GridPoint{0, -h}, GridPoint{0, h}, GridPoint{h, 0}}) body(GridPoint{p.i + d.i, p.j + d.j});
    return;
  }
  if (h < 2) return;
  const int q = h / 2;
  for (const GridPoint& d : {GridPoint{-q, -q}, GridPoint{-q, q}, GridPoint{q, -q}, GridPoint{q, q}}) {
    const GridPoint child{p.i + d.i, p.j + d.j};
    if (inside(bits, child)) body(child);
  }
}

/// Every ancestor but the corners, once, nearest level first: at most 8 a level (7 were counted at k = 7), so O(log n).
template <class Body>
void for_each_ancestor(int bits, GridPoint p, const Body& body) {
  std::array<GridPoint, 16> buffers[2];
  GridPoint *now = buffers[0].data(), *next = buffers[1].data();
  std::size_t count = 1;
  now[0] = p;
  for (int level = split_of(bits, p).level; level > 0; --level) {
    // As split_of() and for_each_parent(), of a level that is known.
    const int t = bits - 1 - level / 2, h = 1 << t, steps = 1 << bits;
    std::size_t found = 0;
    const auto add = [&](int i, int j) {
      for (std::size_t m = 0; m < found; ++m)
        if (next[m].i == i && next[m].j == j) return;
      next[found++] = {i, j};
    };
    for (std::size_t n = 0; n < count; ++n) {
      const auto [i, j] = now[n];
      if (level % 2 == 0) {
        const int across = (((i >> (t + 1)) + (j >> (t + 1))) & 1) == 0 ? -h : h;
        add(i - h, j - across);
        add(i + h, j + across);
      } else if (((i >> t) & 1) != 0) {
        if (j > 0) add(i, j - h);
        if (j < steps) add(i, j + h);
      } else {
        if (i > 0) add(i - h, j);
        if (i < steps) add(i + h, j);
      }
    }
    for (std::size_t n = 0; n < found; ++n) body(next[n]);
    GridPoint* const before = now;
    now = next;
    next = before;
    count = found;
  }
}

/// A triangle: its right angle, then the ends of its longest side so that the three run counter-clockwise in (i, j).
struct GridTriangle {
  GridPoint apex, a, b;
};

/// The two triangles of the square, in the order of all traversals.
[[nodiscard]] inline std::array<GridTriangle, 2> root_triangles(int bits) {
  const int s = 1 << bits;
  return {{{{s, 0}, {s, s}, {0, 0}}, {{0, s}, {0, 0}, {s, s}}}};
}

[[nodiscard]] inline bool can_split(const GridTriangle& t) { return (((t.a.i + t.b.i) | (t.a.j + t.b.j)) & 1) == 0; }
[[nodiscard]] inline GridPoint middle(const GridTriangle& t) { return {(t.a.i + t.b.i) / 2, (t.a.j + t.b.j) / 2}; }

/// Calls body(triangle) for the triangles of the mesh whose points are those with is_there(point), depth first.
template <class IsThere, class Body>
void for_each_leaf(const GridTriangle& t, const IsThere& is_there, const Body& body) {
  if (can_split(t)) {
    const GridPoint m = middle(t);
    if (is_there(m)) {
      for_each_leaf(GridTriangle{m, t.b, t.apex}, is_there, body);
      for_each_leaf(GridTriangle{m, t.apex, t.a}, is_there, body);
      return;
    }
  }
  body(t);
}

}  // namespace etalon::terrain
