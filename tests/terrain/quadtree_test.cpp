#include "core/terrain/quadtree.h"

#include <doctest/doctest.h>

#include <map>
#include <set>
#include <vector>

using namespace etalon::terrain;

namespace {

std::vector<std::uint32_t> parents_of(int bits, GridPoint p) {
  std::vector<std::uint32_t> parents;
  for_each_parent(bits, p, split_of(bits, p), [&](GridPoint q) { parents.push_back(point_index(bits, q)); });
  return parents;
}

}  // namespace

TEST_CASE("quadtree: the nine points of 3x3 by hand") {
  CHECK(split_of(1, {0, 0}).level == -1);
  CHECK(split_of(1, {2, 0}).level == -1);
  CHECK(split_of(1, {0, 2}).level == -1);
  CHECK(split_of(1, {2, 2}).level == -1);
  const Split middle_split = split_of(1, {1, 1});
  CHECK(middle_split.level == 0);
  CHECK(middle_split.along == GridPoint{1, 1});
  CHECK(middle_split.across == GridPoint{1, -1});
  const Split side = split_of(1, {1, 0});
  CHECK(side.level == 1);
  CHECK(side.along == GridPoint{1, 0});
  CHECK(parents_of(1, {1, 0}) == std::vector<std::uint32_t>{4});  // the border has one
}

TEST_CASE("quadtree: parents and children name each other, one level apart; every edge is one that its level has") {
  for (const int bits : {2, 3, 5}) {
    const int steps = 1 << bits;
    std::map<std::uint32_t, std::set<std::uint32_t>> children;
    for (int j = 0; j <= steps; ++j)
      for (int i = 0; i <= steps; ++i) {
        const GridPoint p{i, j};
        const Split split = split_of(bits, p);
        if (split.level < 0) continue;
        const auto parents = parents_of(bits, p);
        const bool on_border = i == 0 || j == 0 || i == steps || j == steps;
        CHECK(parents.size() == (on_border ? 1 : 2));
        for (const std::uint32_t parent : parents) {
          const int level = split_of(bits, point_at(bits, parent)).level;
          if (level >= 0) CHECK(level == split.level - 1);
          if (level < 0) CHECK(split.level == 0);
          children[parent].insert(point_index(bits, p));
        }
        // The ends of the edge came earlier.
        for (const int sign : {-1, 1}) {
          const GridPoint end{i + sign * split.along.i, j + sign * split.along.j};
          REQUIRE(inside(bits, end));
          CHECK(split_of(bits, end).level < split.level);
        }
      }
    for (int j = 0; j <= steps; ++j)
      for (int i = 0; i <= steps; ++i) {
        const Split split = split_of(bits, {i, j});
        if (split.level < 0) continue;
        std::set<std::uint32_t> named;
        for_each_child(bits, {i, j}, split, [&](GridPoint c) { named.insert(point_index(bits, c)); });
        CHECK(named == children[point_index(bits, {i, j})]);
      }
  }
}

TEST_CASE("quadtree: ancestors are the closure of parents, each once, at most eight of a level") {
  const int bits = 6, side = (1 << bits) + 1;
  std::size_t most = 0;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      std::set<std::uint32_t> expected;
      std::vector<GridPoint> open{{i, j}};
      while (!open.empty()) {
        const GridPoint p = open.back();
        open.pop_back();
        if (split_of(bits, p).level < 0) continue;
        for_each_parent(bits, p, split_of(bits, p), [&](GridPoint q) {
          if (split_of(bits, q).level >= 0 && expected.insert(point_index(bits, q)).second) open.push_back(q);
        });
      }
      std::vector<std::uint32_t> found;
      std::map<int, std::size_t> of_level;
      for_each_ancestor(bits, {i, j}, [&](GridPoint q) {
        found.push_back(point_index(bits, q));
        most = std::max(most, ++of_level[split_of(bits, q).level]);
      });
      CHECK(found.size() == expected.size());
      CHECK(std::set<std::uint32_t>(found.begin(), found.end()) == expected);
    }
  CHECK(most <= 8);
}

TEST_CASE("quadtree: ancestors a point grow by less than 14 with each k, so pruning visits O(n log n) of them") {
  const auto mean = [](int bits) {
    const int side = (1 << bits) + 1;
    double count = 0;
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) for_each_ancestor(bits, {i, j}, [&](GridPoint) { ++count; });
    return count / side / side;
  };
  double before = mean(5);
  for (const int bits : {6, 7, 8}) {
    const double now = mean(bits);
    CHECK(now - before > 10);
    CHECK(now - before < 14);  // 7 of each of two levels, fewer at the border
    before = now;
  }
}

TEST_CASE("quadtree: with every point there, the leaves tile the square, counter-clockwise, twice a square's triangles") {
  const int bits = 4;
  std::size_t count = 0;
  long long twice_area = 0;
  for (const GridTriangle& root : root_triangles(bits))
    for_each_leaf(
        root, [](GridPoint) { return true; },
        [&](const GridTriangle& t) {
          const long long area =
              static_cast<long long>(t.a.i - t.apex.i) * (t.b.j - t.apex.j) - static_cast<long long>(t.a.j - t.apex.j) * (t.b.i - t.apex.i);
          CHECK(area == 1);
          twice_area += area;
          ++count;
        });
  CHECK(count == 2 * 16 * 16);
  CHECK(twice_area == 2 * 16 * 16);
}
