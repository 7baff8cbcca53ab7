// The texels that a triangle covers, row by row, decided in integers by the contract's default rules (docs/contract.md#coverage): 1/256
// texel, left_ymin. What bookkeeping beside the renderers needs, the same for every renderer.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/math/vec.h"

namespace etalon::adapt {

/// In 1/256 texel.
struct GridPoint {
  std::int64_t x = 0, y = 0;
};

/// A texture coordinate on the grid of a map, half to even: what snap() gives for the default state. |uv| · size < 2^21.
[[nodiscard]] inline GridPoint on_grid(const Vec2f& uv, int width, int height) {
  const auto rounded = [](double at) {
    const double below = std::floor(at), rest = at - below;
    const auto n = static_cast<std::int64_t>(below);
    return rest > 0.5 || (rest == 0.5 && n % 2 != 0) ? n + 1 : n;
  };
  return {rounded(static_cast<double>(uv.x) * width * 256), rounded(static_cast<double>(uv.y) * height * 256)};
}

/// Twice the area, positive where a, b, c are counter-clockwise.
[[nodiscard]] inline std::int64_t doubled_area(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Calls span(y, begin, end) for each row of a width × height map in which the triangle covers the texels begin <= x < end; rows ascend.
/// A sample on an edge counts as if it were moved right by nothing and then up by less: that is left_ymin.
template <class Span>
void for_texel_spans(const std::array<GridPoint, 3>& triangle, int width, int height, const Span& span) {
  const auto ceil_div = [](std::int64_t n, std::int64_t d) { return n >= 0 ? (n + d - 1) / d : -(-n / d); };  // d > 0
  const auto [low, high] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
  // Rows whose sample, at 256·y + 128, is in [low, high).
  const std::int64_t first = std::max<std::int64_t>(0, ceil_div(low - 128, 256)),
                     last = std::min<std::int64_t>(height, ceil_div(high - 128, 256));
  for (std::int64_t y = first; y < last; ++y) {
    const std::int64_t at = 256 * y + 128;
    std::array<std::int64_t, 2> column{};  // the first texel right of each of the two edges that cross the row
    int crossed = 0;
    for (int k = 0; k < 3; ++k) {
      GridPoint a = triangle[static_cast<std::size_t>(k)], b = triangle[static_cast<std::size_t>((k + 1) % 3)];
      if (a.y > b.y) std::swap(a, b);
      if (at < a.y || at >= b.y || crossed == 2) continue;
      // 256·x + 128 >= a.x + (at − a.y)(b.x − a.x)/(b.y − a.y)
      const std::int64_t dy = b.y - a.y;
      column[static_cast<std::size_t>(crossed++)] = ceil_div((a.x - 128) * dy + (at - a.y) * (b.x - a.x), 256 * dy);
    }
    const std::int64_t begin = std::max<std::int64_t>(0, std::min(column[0], column[1]));
    const std::int64_t end = std::min<std::int64_t>(width, std::max(column[0], column[1]));
    if (begin < end) span(static_cast<int>(y), static_cast<int>(begin), static_cast<int>(end));
  }
}

}  // namespace etalon::adapt
