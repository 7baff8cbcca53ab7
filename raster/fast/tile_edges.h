// A triangle's exact edge functions seen from one tile: integers at its first sample there, and their steps.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/draw/draw_list.h"
#include "raster/visibility.h"

namespace etalon::raster::fast {

/// Counter-clockwise whatever the input's order, edge k opposite vertex k. Widths as in raster/edges.h: all below 2^62.
struct TileEdges {
  int column0, column1, row0, row1;            ///< texels of the tile whose samples lie in the bounding box, from the tile's first
  std::array<std::int64_t, 3> value;           ///< at (column0, row0)
  std::array<std::int64_t, 3> dx, dy;          ///< along the edges, sub-texels
  std::array<std::int64_t, 3> step_x, step_y;  ///< change per column and row
  std::array<bool, 3> owns;                    ///< whether 0 counts as inside
  std::int64_t area2;                          ///< twice the area, > 0

  /// Sets everything; false where the triangle draws nothing in the tile.
  bool set(const RasterVertex& v0, const RasterVertex& v1, const RasterVertex& v2, const RasterState& state, const Tile& tile) {
    const int bits = state.subtexel_bits;
    const std::int64_t half = std::int64_t{1} << (bits - 1);
    const auto first = [&](std::int64_t lo, int origin) {  // ceil(lo − ½) from the tile's first texel
      return static_cast<int>(std::max<std::int64_t>(((lo + half - 1) >> bits) - origin, 0));
    };
    const auto last = [&](std::int64_t hi, int origin, int size) {
      return static_cast<int>(std::min<std::int64_t>(((hi - half) >> bits) - origin, size - 1));
    };
    column0 = first(std::min({v0.x, v1.x, v2.x}), tile.x0), column1 = last(std::max({v0.x, v1.x, v2.x}), tile.x0, tile.width);
    row0 = first(std::min({v0.y, v1.y, v2.y}), tile.y0), row1 = last(std::max({v0.y, v1.y, v2.y}), tile.y0, tile.height);
    if (column0 > column1 || row0 > row1) return false;

    // Corners from the sample at (column0, row0).
    const std::int64_t px = (std::int64_t{tile.x0 + column0} << bits) + half, py = (std::int64_t{tile.y0 + row0} << bits) + half;
    std::array<std::int64_t, 3> x = {v0.x - px, v1.x - px, v2.x - px}, y = {v0.y - py, v1.y - py, v2.y - py};
    area2 = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
    if (area2 == 0 || (area2 < 0 && state.cull == CullMode::clockwise) || (area2 > 0 && state.cull == CullMode::counter_clockwise))
      return false;
    const std::int64_t sign = area2 < 0 ? -1 : 1;
    area2 *= sign;
    const bool left = state.fill_rule == FillRule::left_ymin || state.fill_rule == FillRule::left_ymax;
    const bool ymin = state.fill_rule == FillRule::left_ymin || state.fill_rule == FillRule::right_ymin;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = k == 2 ? 0 : k + 1, b = k == 0 ? 2 : k - 1;
      dx[k] = sign * (x[b] - x[a]), dy[k] = sign * (y[b] - y[a]);
      value[k] = sign * (x[a] * y[b] - y[a] * x[b]);
      step_x[k] = -dy[k] * (2 * half), step_y[k] = dx[k] * (2 * half);
      owns[k] = dy[k] != 0 ? (dy[k] < 0) == left : (dx[k] > 0) == ymin;
    }
    return true;
  }
};

}  // namespace etalon::raster::fast
