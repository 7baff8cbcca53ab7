// The texture map of a baked scan: one half-square triangle of texels for each triangle of the mesh [Soucy, Godin & Rioux 1996, sec. 2, 3].
#pragma once

#include <array>

#include "core/bake/triangle_sizes.h"

namespace etalon::bake {

/// A texel of the map by column and row; row 0 is v = 0.
struct TexelPlace {
  int x = 0, y = 0;
  friend bool operator==(const TexelPlace&, const TexelPlace&) = default;
};

/// The half-square triangle of one face. Its own texels have coordinates (i, j), i, j ≥ 0, i + j < size, and cover [i, i+1) × [j, j+1) of a
/// plane in which its corners are (0, 0), (size, 0) and (0, size): all points of it but those of the hypotenuse with integer coordinates
/// lie in its own texels.
struct Tile {
  /// Lowest column and row of the rectangle of size × (size + 1) texels whose lower left or upper right half it is; without a gutter the other
  /// half is another's.
  int x = 0, y = 0;
  int size = 2;          ///< d, a power of two
  bool turned = false;   ///< by 180°: it is the upper right half, with the same orientation
  int right_corner = 0;  ///< the face's corner at (0, 0); the next one, counter-clockwise, is at (size, 0)

  [[nodiscard]] TexelPlace place(int i, int j) const {
    return turned ? TexelPlace{x + size - 1 - i, y + size - j} : TexelPlace{x + i, y + j};
  }
  /// 0 to 2: which corner of the tile the face's corner is.
  [[nodiscard]] int slot(int corner) const { return (corner - right_corner + 3) % 3; }
  /// The texel at a corner of the face, and the `step`-th texel, 0 to size − 1, of the side from one corner of it to another.
  [[nodiscard]] std::array<int, 2> corner_texel(int corner) const;
  [[nodiscard]] std::array<int, 2> side_texel(int from_corner, int to_corner, int step) const;
  /// Weights of the face's corners at the centre of texel (i, j): each in [0, 1], exact.
  [[nodiscard]] Vec3d center_weights(int i, int j) const;
  /// The texel whose centre is nearest, in the texture, to the point of these weights (each in [0, 1], sum 1 up to rounding); of several
  /// equally near ones that with the largest i, then j, but its own.
  [[nodiscard]] std::array<int, 2> nearest_texel(const Vec3d& weights) const;
  friend bool operator==(const Tile&, const Tile&) = default;
};

struct Atlas {
  int width = 0, height = 0;                    ///< texels
  std::vector<Tile> tiles;                      ///< #F
  std::size_t reductions = 0, handed_down = 0;  ///< as TriangleSizes
  Gutter gutter;
  std::uint64_t rows = 0;          ///< that the tiling takes from the map's top
  std::uint64_t rows_without = 0;  ///< that triangles of these sizes take without a gutter

  /// Texels of all triangles.
  [[nodiscard]] std::uint64_t inside_count() const;
  /// Texels of their borders; 0 without a gutter.
  [[nodiscard]] std::uint64_t border_count() const;
};

/// The atlas of a mesh whose scan has the mean spacing `spacing` (above 0, model units). Its longest side is each triangle's hypotenuse (ties:
/// the side that starts at the lower corner). Rectangles are placed from the largest, in each size two faces in ascending order to one;
/// with a gutter as tile_pairs() does. InputError as choose_sizes().
[[nodiscard]] Atlas make_atlas(const Mesh& mesh, double spacing, int width, int height, Gutter gutter = {});
/// The same for given ratios of sizes, all of whose triangles have the right angle at corner 0.
[[nodiscard]] Atlas make_atlas(const std::vector<double>& ratios, int width, int height, Gutter gutter = {});

/// How far each side of a triangle of size d is drawn in, as a share of d: 1/8192, or more where float32 coordinates need it, so that a point
/// interpolated with an error of 5·2^-24 in each coordinate still falls in a texel of its own (docs/papers/bake.md).
[[nodiscard]] double drawn_in_share(const Atlas& atlas);
/// Where a corner of a face is in the map, in texels (row 0 at v = 0): on the corner of its texels, drawn in towards the centre of the
/// inscribed circle so that each side moves by share · size. 0 gives the paper's corners.
[[nodiscard]] Vec2d corner_place(const Tile& tile, int corner, double share);

}  // namespace etalon::bake
