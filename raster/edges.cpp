#include "raster/edges.h"

#include <algorithm>

namespace etalon::raster {
namespace {

// dx and dy are not both 0.
bool owns_zero(FillRule rule, std::int64_t dx, std::int64_t dy) {
  const bool left = rule == FillRule::left_ymin || rule == FillRule::left_ymax;
  const bool ymin = rule == FillRule::left_ymin || rule == FillRule::right_ymin;
  return dy != 0 ? (dy < 0) == left : (dx > 0) == ymin;
}

std::int64_t floor_div(std::int64_t a, std::int64_t b) {  // b > 0
  const std::int64_t q = a / b;
  return q - (a % b < 0 ? 1 : 0);
}

// Texels whose centres lie in [lo, hi] sub-texels, clipped to [0, size).
std::array<int, 2> texel_range(std::int64_t lo, std::int64_t hi, int subtexel_bits, int size) {
  const std::int64_t half = std::int64_t{1} << (subtexel_bits - 1);
  const std::int64_t first = (lo - half + 2 * half - 1) >> subtexel_bits;  // ceil
  const std::int64_t last = (hi - half) >> subtexel_bits;                  // floor
  return {static_cast<int>(std::max<std::int64_t>(first, 0)), static_cast<int>(std::min<std::int64_t>(last, size - 1))};
}

}  // namespace

Edges make_edges(const RasterVertex& v0, const RasterVertex& v1, const RasterVertex& v2, const Frame& frame) {
  Edges edges;
  edges.subtexel_bits = frame.state.subtexel_bits;
  const std::array<const RasterVertex*, 3> v = {&v0, &v1, &v2};
  const std::int64_t area2 =
      (std::int64_t{v1.x} - v0.x) * (std::int64_t{v2.y} - v0.y) - (std::int64_t{v1.y} - v0.y) * (std::int64_t{v2.x} - v0.x);
  if (area2 == 0) return edges;
  if (area2 < 0 && frame.state.cull == CullMode::clockwise) return edges;
  if (area2 > 0 && frame.state.cull == CullMode::counter_clockwise) return edges;
  for (int i = 0; i < 3; ++i) {
    const RasterVertex& a = *v[area2 > 0 ? (i + 1) % 3 : (i + 2) % 3];
    const RasterVertex& b = *v[area2 > 0 ? (i + 2) % 3 : (i + 1) % 3];
    edges.dx[i] = std::int64_t{b.x} - a.x;
    edges.dy[i] = std::int64_t{b.y} - a.y;
    edges.c[i] = edges.dy[i] * a.x - edges.dx[i] * a.y;
    edges.owns[i] = owns_zero(frame.state.fill_rule, edges.dx[i], edges.dy[i]);
  }
  edges.area2 = area2 < 0 ? -area2 : area2;
  const auto [x_lo, x_hi] = std::minmax({v0.x, v1.x, v2.x});
  const auto [y_lo, y_hi] = std::minmax({v0.y, v1.y, v2.y});
  const auto columns = texel_range(x_lo, x_hi, edges.subtexel_bits, frame.width);
  const auto rows = texel_range(y_lo, y_hi, edges.subtexel_bits, frame.height);
  edges.i_min = columns[0], edges.i_max = columns[1];
  edges.j_min = rows[0], edges.j_max = rows[1];
  return edges;
}

std::array<int, 2> Edges::span(int j) const {
  // E at column i is e0 − step·i with step = dy·2^b: solve E > 0, or E >= 0 where owned, for i by one exact division an edge.
  const std::int64_t py = sample_subtexel(j), px0 = sample_subtexel(0);
  std::int64_t first = i_min, last = i_max;
  for (int k = 0; k < 3; ++k) {
    const std::int64_t e0 = dx[k] * py - dy[k] * px0 + c[k] - (owns[k] ? 0 : 1);  // inside where e0 − step·i >= 0
    const std::int64_t step = dy[k] << subtexel_bits;
    if (step == 0) {
      if (e0 < 0) return {0, -1};
    } else if (step > 0) {
      last = std::min(last, floor_div(e0, step));
    } else {
      first = std::max(first, -floor_div(e0, -step));
    }
  }
  return {static_cast<int>(first), static_cast<int>(last)};
}

}  // namespace etalon::raster
