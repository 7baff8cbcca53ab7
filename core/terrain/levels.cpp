#include "core/terrain/levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.h"
#include "core/terrain/quadtree.h"

namespace etalon::terrain {

namespace {

std::size_t points_of(int bits) {
  const auto side = (std::size_t{1} << bits) + 1;
  return side * side;
}

// base^exponent by squaring, in a fixed order.
double power(double base, std::size_t exponent) {
  double result = 1;
  for (; exponent > 0; exponent >>= 1) {
    if ((exponent & 1u) != 0) result *= base;
    base *= base;
  }
  return result;
}

// The `degree`-th root of x >= 1, to the last bit or two, by bisection.
double root(double x, std::size_t degree) {
  double low = 1, high = x;
  for (;;) {
    const double at = low + (high - low) / 2;
    if (at <= low || at >= high) return low;
    (power(at, degree) <= x ? low : high) = at;
  }
}

void require_level(const Levels& levels, std::size_t level) {
  if (level >= levels.count()) throw InputError(fmt::format("level: expected 0 to {}, got {}", levels.count() - 1, level));
}

template <class Body>
void for_each_triangle(const Levels& levels, std::size_t level, const Body& body) {
  const auto is_there = [&](GridPoint p) { return levels.first_level[point_index(levels.bits, p)] <= level; };
  for (const GridTriangle& triangle : root_triangles(levels.bits)) for_each_leaf(triangle, is_there, body);
}

void require_same_grid(const HeightField& field, const Levels& levels) {
  if (field.bits != levels.bits || field.heights.size() != levels.first_level.size())
    throw InputError(fmt::format("levels: expected those of a grid of k = {}, got k = {}", field.bits, levels.bits));
}

}  // namespace

std::vector<std::uint32_t> geometric_counts(int bits, double from, double to, std::size_t count) {
  if (bits < kMinGridBits || bits > kMaxGridBits || !(from > 0) || !(to > from) || !(to <= 1) || count < 2 || count > kMaxLevels)
    throw InputError(
        fmt::format("levels: expected 2 to {} of shares 0 < from < to <= 1, got {} from {} to {}", kMaxLevels, count, from, to));
  const auto points = static_cast<double>(points_of(bits));
  const double step = root(to / from, count - 1);
  std::vector<std::uint32_t> counts;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = i + 1 == count ? to : from * power(step, i);
    counts.push_back(static_cast<std::uint32_t>(std::max(4.0, std::nearbyint(points * share))));
  }
  return counts;
}

Levels make_levels(int bits, const RemovalOrder& order, std::span<const std::uint32_t> vertex_counts) {
  if (vertex_counts.empty() || vertex_counts.size() > kMaxLevels)
    throw InputError(fmt::format("levels: expected 1 to {}, got {}", kMaxLevels, vertex_counts.size()));
  const std::size_t points = points_of(bits);
  if (order.points.size() + 4 != points)
    throw InputError(fmt::format("levels: expected an order of {} points, got {}", points - 4, order.points.size()));
  Levels levels;
  levels.bits = bits;
  levels.first_level.assign(points, 0);
  std::uint32_t before = 4;
  for (const std::uint32_t count : vertex_counts) {
    if (count < before || count > points)
      throw InputError(fmt::format("levels: expected ascending counts of {} to {} vertices, got {}", before, points, count));
    levels.vertex_counts.push_back(before = count);
  }
  // The last to go come first into a level.
  std::size_t level = 0, there = 4;
  for (auto v = order.points.rbegin(); v != order.points.rend(); ++v, ++there) {
    while (level < levels.count() && there >= levels.vertex_counts[level]) ++level;
    levels.first_level[*v] = level < levels.count() ? static_cast<std::uint16_t>(level) : kNoLevel;
  }
  return levels;
}

Levels uniform_grid(int bits, int j) {
  if (bits < kMinGridBits || bits > kMaxGridBits || j < 0 || j > bits)
    throw InputError(fmt::format("uniform grid: expected j of 0 to k = {}, got {}", bits, j));
  Levels levels;
  levels.bits = bits;
  const std::uint32_t side = (1u << j) + 1;
  levels.vertex_counts = {side * side};
  levels.first_level.assign(points_of(bits), kNoLevel);
  const int step = 1 << (bits - j);
  for (int y = 0; y <= 1 << bits; y += step)
    for (int x = 0; x <= 1 << bits; x += step) levels.first_level[point_index(bits, {x, y})] = 0;
  return levels;
}

Mesh level_mesh(const HeightField& field, const Levels& levels, std::size_t level) {
  require_same_grid(field, levels);
  require_level(levels, level);
  std::vector<std::array<std::uint32_t, 3>> faces;
  for_each_triangle(levels, level, [&](const GridTriangle& t) {
    faces.push_back({point_index(field.bits, t.apex), point_index(field.bits, t.a), point_index(field.bits, t.b)});
  });
  std::vector<std::uint32_t> points;
  points.reserve(levels.vertex_counts[level]);
  for (std::uint32_t v = 0; v < levels.first_level.size(); ++v)
    if (levels.first_level[v] <= level) points.push_back(v);

  Mesh mesh;
  mesh.has_uv = true;
  for (std::uint32_t n = 0; n < points.size(); ++n) {
    const GridPoint p = point_at(field.bits, points[n]);
    mesh.positions.emplace_back(field.position(p.i, p.j));
    mesh.wedges.push_back({VertexId(n), Vec2f(field.uv(p.i, p.j))});
  }
  for (const std::array<std::uint32_t, 3>& face : faces) {
    std::array<WedgeId, 3> corners;
    for (std::size_t c = 0; c < 3; ++c)
      corners[c] = WedgeId(static_cast<std::size_t>(std::lower_bound(points.begin(), points.end(), face[c]) - points.begin()));
    mesh.faces.push_back(corners);
  }
  return mesh;
}

LevelError level_error(const HeightField& field, const Levels& levels, std::size_t level) {
  return level_error(field, field, levels, level);
}

LevelError level_error(const HeightField& field, const HeightField& coded, const Levels& levels, std::size_t level) {
  require_same_grid(field, levels);
  require_same_grid(coded, levels);
  require_level(levels, level);
  double sum = 0, largest = 0;
  for_each_triangle(levels, level, [&](const GridTriangle& t) {
    // Twice the areas of (p, a, b), (apex, p, b), (apex, a, p): integers, positive inside; a point on a shared edge is taken by the triangle
    // whose edge it closes: left and lower ones, as the rasterizer's rule left_ymin; the square's own right and upper border by its triangles.
    const auto side = [](GridPoint from, GridPoint to, int i, int j) {
      return static_cast<std::int64_t>(to.i - from.i) * (j - from.j) - static_cast<std::int64_t>(to.j - from.j) * (i - from.i);
    };
    const int last = field.steps();
    const auto takes = [&](GridPoint from, GridPoint to, std::int64_t e) {
      if (e != 0) return e > 0;
      const int di = to.i - from.i, dj = to.j - from.j;
      const bool is_border = (di == 0 && from.i == last) || (dj == 0 && from.j == last);
      return is_border || dj < 0 || (dj == 0 && di > 0);
    };
    const double twice_area = static_cast<double>(side(t.apex, t.a, t.b.i, t.b.j));
    const double zp = coded.height(t.apex.i, t.apex.j) * coded.unit, za = coded.height(t.a.i, t.a.j) * coded.unit,
                 zb = coded.height(t.b.i, t.b.j) * coded.unit;
    for (int j = std::min({t.apex.j, t.a.j, t.b.j}); j <= std::max({t.apex.j, t.a.j, t.b.j}); ++j)
      for (int i = std::min({t.apex.i, t.a.i, t.b.i}); i <= std::max({t.apex.i, t.a.i, t.b.i}); ++i) {
        const std::int64_t ep = side(t.a, t.b, i, j), ea = side(t.b, t.apex, i, j), eb = side(t.apex, t.a, i, j);
        if (!takes(t.a, t.b, ep) || !takes(t.b, t.apex, ea) || !takes(t.apex, t.a, eb)) continue;
        const double plane = (zp * static_cast<double>(ep) + za * static_cast<double>(ea) + zb * static_cast<double>(eb)) / twice_area;
        const double error = std::fabs(field.height(i, j) * field.unit - plane);
        sum += error * error;
        largest = std::max(largest, error);
      }
  });
  return {std::sqrt(sum / static_cast<double>(field.point_count())), largest};
}

}  // namespace etalon::terrain
