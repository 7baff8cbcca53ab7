// A border around each triangle of the map, so that linear lookups in the map and in its mip levels see that triangle alone.
//
// Level L is level 0 averaged over blocks of 2^L × 2^L texels from texel (0, 0). With a gutter for levels 0 to N, B = 2^N, the legs of every
// triangle lie on multiples of B and cells of B × B texels around it are its own: in its own coordinates, n = size / B, the cells (I, J) with
// −1 ≤ I, J ≤ n and I + J ≤ n; for n = ½ the four with −1 ≤ I, J ≤ 0. No bilinear lookup at a point of the triangle, in levels 0 to N, weighs
// a texel elsewhere (docs/papers/bake.md has the proof).
#pragma once

#include <optional>
#include <vector>

#include "core/bake/tiling.h"
#include "core/image/image.h"

namespace etalon::bake {

struct Atlas;
struct Tile;

/// Mip levels that linear lookup is safe in, beside level 0: 0 to 8; none: no gutter.
using Gutter = std::optional<int>;
inline constexpr int kLargestGutter = 8;

/// The least size that saves room: 2; with a gutter half its border, below which a triangle takes as many cells.
[[nodiscard]] constexpr int least_size(Gutter gutter) { return gutter && *gutter > 2 ? 1 << (*gutter - 1) : 2; }

/// Texels of the rectangle that two triangles of one size share with their borders: (n + 2)·B × (n + 5)·B, for n = ½ 2·B × 4·B.
struct PairBlock {
  int width = 0, height = 0;
};
[[nodiscard]] PairBlock pair_block(int size, int gutter);

/// `count` pairs of one size, row by row in `columns` columns, from column `x` and row `top` of the map's top.
struct PairRun {
  int size = 2;
  int x = 0;
  std::uint64_t top = 0;
  std::uint64_t columns = 1, count = 0;
  friend bool operator==(const PairRun&, const PairRun&) = default;
};
struct PairTiling {
  std::vector<PairRun> runs;  ///< sizes descend
  std::uint64_t height = 0;   ///< rows from the top
};

/// Places the pairs of each size, from the largest (an odd class takes a rectangle for its last triangle): first in what is left free beside
/// and under larger ones, in the order in which that came to be; what does not fit there begins rows of its own below. ETALON_CHECKs that one
/// rectangle of each size fits the width.
[[nodiscard]] PairTiling tile_pairs(const SizeCounts& counts, int width, int gutter);

/// As those of tiling.h, all triangles being of the least size. The height is 2^64 − 1 where a map of `width` can hold none.
[[nodiscard]] std::uint64_t least_height(std::uint64_t triangles, int width, Gutter gutter);
[[nodiscard]] std::uint64_t least_square(std::uint64_t triangles, Gutter gutter);

/// How many texels of borders a triangle has.
[[nodiscard]] std::uint64_t border_texels(int size, int gutter);

/// Calls visit(i, j) for all texels of a triangle's cells that are not its own triangle's, in its coordinates: i, j from −2^gutter.
template <class Visit>
void for_each_border_texel(int size, int gutter, const Visit& visit) {
  const int border = 1 << gutter;
  const bool small = 2 * size <= border;
  const int end = small ? border : size + border;
  for (int j = -border; j < end; ++j)
    for (int i = -border; i < end; ++i) {
      if (i >= 0 && j >= 0 && i + j < size) continue;
      // Shifts round down: to the cells.
      if (small || (i >> gutter) + (j >> gutter) <= size >> gutter) visit(i, j);
    }
}

/// Gives the borders of all triangles of an RGB unorm8 map their colours: each that of the nearest texel of the triangle in the texture, but
/// diagonally beyond the hypotenuse's texels a and b, c being the one inside between them, a + b − c, cut to 0..255. So at level 0 the
/// colour along each side of a triangle is that of its side's texels, interpolated from centre to centre: the same in two triangles
/// of one size, up to that cut.
void paint_borders(const Atlas& atlas, Image& image);

}  // namespace etalon::bake
