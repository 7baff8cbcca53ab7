// The loops of the fast path over one run of texels of a tile's row, compiled once per instruction set (kernels.cpp). They decide only
// where a bound proves them right, and say where not. Bounds are derived where they are formed: planes.cpp and the .inc files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/draw/state.h"
#include "raster/fast/planes.h"
#include "raster/simd_level.h"

namespace etalon::raster::fast {

/// Lanes of a run buffer: a row of a tile, and a multiple of every vector length.
inline constexpr int kRunLanes = 64;

/// Bit n: lane n is not decided. Values of lanes at and above the run's length are unspecified.
using LaneMask = std::uint64_t;

struct alignas(64) DoubleLanes {
  double at[kRunLanes];
};
struct alignas(64) FloatLanes {
  float at[kRunLanes];
};
struct alignas(64) IntLanes {
  std::int32_t at[kRunLanes + 8];  ///< a vector may begin at any lane
};

/// A number per lane and a bound on its error: the exact one lies in [value − error, value + error]. The error holds room for one rounding
/// more, of value ± error or of value · image size. It may be +inf, never NaN, and kExactPlane (planes.h), which is negative.
struct Values {
  DoubleLanes value, error;
};

/// Where the lanes of a run lie relative to their triangles' anchors, and 1/Q there.
struct Positions {
  DoubleLanes x, y, reciprocal;
};

/// One axis of a linear lookup: the two texel indices, wrapped, as exact integers, and the weight of the second.
struct LinearAxis {
  DoubleLanes first, second;
  Values fraction;
};

/// The triangles of a run: planes (planes.h), `stride` numbers each, and per lane the number of its triangle. The lanes of the last vector
/// behind the run have triangles too.
struct RunTriangles {
  const double* planes;
  const std::uint32_t* number;
  int stride;
  bool uniform;      ///< all lanes have one triangle
  bool perspective;  ///< some Q is not 1
};

/// The texels of an image that a lookup names.
struct TexelGrid {
  int width, height;
  Wrap wrap_u, wrap_v;
};

/// Triangles are set up so many at once.
inline constexpr int kBatch = 8;
/// Sub-texels from end to end up to which a triangle is small: a tile's width at 8 bits.
inline constexpr std::int32_t kMostSmallExtent = 1 << 14;

/// Corners of kBatch triangles: x and y in turns, sub-texels, and depth.
struct alignas(64) CornerBatch {
  std::int32_t xy[3][2 * kBatch];
  float z[3][kBatch];
};

/// Corners of kBatch triangles as planes need them: sub-texels, w, and the attributes of planes.h (weights are not read).
struct alignas(64) PlaneBatch {
  std::int32_t x[3][kBatch], y[3][kBatch];
  float w[3][kBatch];
  float attribute[kPlaneWeight0][3][kBatch];
};

/// What setting up triangles takes from frame and tile.
struct TileFrame {
  std::int32_t x0, y0;  ///< sub-texels of the tile's first texel's corner
  int width, height;    ///< texels of the tile
  int subtexel_bits;
  CullMode cull;
  bool left, ymin;  ///< the fill rule
};

/// kBatch triangles over the boxes of samples each can cover in the tile. Counter-clockwise, edge k opposite vertex k.
struct alignas(64) SmallTriangles {
  std::int32_t column[kBatch], row[kBatch];            ///< the box's first sample, from the tile's
  std::int32_t last_column[kBatch], last_row[kBatch];  ///< from the box's first
  std::int32_t value[3][kBatch], biased[3][kBatch];    ///< edge functions there; biased: inside is >= 0
  std::int32_t x[3][kBatch], y[3][kBatch];             ///< change per column and row
  std::int32_t area2[kBatch], clockwise[kBatch];       ///< twice the area; −1 where the input is clockwise, else 0
  double depth[kBatch], depth_x[kBatch], depth_y[kBatch], depth_error[kBatch];
  unsigned empty, other;  ///< bits: draws nothing in the tile; is not small
};

/// Lookups of kLookupBlock at a time: texels (i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1) of four bytes with weights (1 − fx)(1 − fy), fx(1 − fy) …
inline constexpr std::size_t kLookupBlock = 16;
struct LookupBlocks {
  const std::uint32_t* texel;                 ///< (i, j)
  const float *fx, *fy;                       ///< in [0, 1], within 2^-25 of the exact ones
  const std::array<std::uint8_t, 4>* wanted;  ///< R, G, B, 255
};
/// Textures that are looked up at once.
inline constexpr std::size_t kGroupTextures = 8;

struct Kernels {
  /// All but depth; then that.
  void (*set_up_small)(const CornerBatch& corners, const TileFrame& frame, SmallTriangles& result);
  void (*set_up_small_depth)(const CornerBatch& corners, SmallTriangles& result);
  /// Draws triangles first..count-1 into a tile (rows kTileSize apart): nearest depth wins; without `depth` the
  /// last. Triangle t writes first_slot + t. Stops at the first that is not small or whose depth is not decided, and returns it, or count;
  /// of that one some texels may have been drawn. Adds the depths worked out to `values`.
  int (*draw_small)(const SmallTriangles& triangles, int first, int count, std::uint32_t first_slot, std::uint32_t* slots, float* depth,
                    std::uint64_t& values);
  /// The planes of kBatch triangles that have covered samples in the tile, layout.stride() numbers each; see make_planes() of planes.h. Needs
  /// at most kMostEdgeBits sub-texel bits. Lanes of other triangles get unspecified numbers.
  bool (*make_planes)(const PlaneBatch& batch, const TileFrame& frame, const PlaneLayout& layout, double* out);
  /// How many of the first `count` numbers (1..64) equal the first.
  int (*equal_run)(const std::uint32_t* numbers, int count);
  /// numbers[i] = table[slots[i]]; `count` is a multiple of 16.
  void (*renumber)(const std::uint32_t* slots, std::size_t count, const std::uint32_t* table, std::uint32_t* numbers);
  /// seen[slots[i]] = 1.
  void (*mark)(const std::uint32_t* slots, std::size_t count, std::uint32_t* seen);
  /// How many of the first `count` numbers come before the first 0.
  int (*nonzero_run)(const std::uint32_t* numbers, int count);
  /// Positions of texels (column + lane, row), relative to the tile.
  void (*positions)(const RunTriangles& run, int lanes, int column, int row, Positions& result);
  /// The attribute whose plane starts `attribute` doubles into each triangle's planes, and whose error lies `error` doubles into them.
  void (*attribute)(const RunTriangles& run, int lanes, int attribute, int error, const Positions& at, Values& result);
  /// Offsets of the texels that u and v, the attributes whose planes start there, name in an image: the fused way of positions(),
  /// attribute(), nearest_axis() and texel_offsets().
  LaneMask (*nearest_texels)(const RunTriangles& run, int lanes, int column, int row, int u, int v, const TexelGrid& grid,
                             IntLanes& offset);
  /// floor(u·size), wrapped.
  LaneMask (*nearest_axis)(const Values& u, int lanes, int size, Wrap wrap, DoubleLanes& index);
  /// i0 = floor(u·size − ½) and i1 = i0 + 1, wrapped, of the approximate u: the interpolant is continuous, so a wrong side of a border
  /// costs no more than the fraction's error. Not decided where that error exceeds 2^-10.
  LaneMask (*linear_axis)(const Values& u, int lanes, int size, Wrap wrap, LinearAxis& result);
  /// row·width + column, for indices that are in range.
  void (*texel_offsets)(const DoubleLanes& column, const DoubleLanes& row, int lanes, int width, IntLanes& offset);
  /// Texels of four bytes, or of two float32 (zeros become +0), side by side.
  void (*copy_words)(const std::uint32_t* texels, const IntLanes& offset, int lanes, std::byte* to);
  void (*copy_float_pairs)(const float* texels, const IntLanes& offset, int lanes, std::byte* to);
  /// Bilinear value of one channel, in the texels' unit, times `scale`; |t| <= largest over the whole image.
  void (*bilinear)(const DoubleLanes t[4], const LinearAxis& u, const LinearAxis& v, int lanes, double scale, double largest,
                   Values& result);
  /// The same for four channels of unorm8 texels of four bytes at once; values in [0, 1].
  void (*bilinear_rgba8)(const std::byte* texels, const IntLanes offset[4], const LinearAxis& u, const LinearAxis& v, int lanes,
                         Values result[4]);
  /// Bilinear values of two float32 a texel as float32, |t| <= largest over the whole image: the fused way of positions(), attribute(),
  /// linear_axis(), bilinear() and to_float32(), to texels side by side.
  LaneMask (*linear_float_pairs)(const RunTriangles& run, int lanes, int column, int row, int u, int v, const TexelGrid& grid,
                                 const float* texels, double largest, std::byte* to);
  /// round(clamp(value, 0, 1)·scale), scale 255 or 65535.
  LaneMask (*to_unorm)(const Values& v, int lanes, double scale, IntLanes& result);
  /// Nearest float32; zeros are +0.
  LaneMask (*to_float32)(const Values& v, int lanes, FloatLanes& result);
  /// Window depth z0 + lane·dz ± error as float32.
  LaneMask (*depth)(double z0, double dz, double error, int lanes, float* result);
  /// Nearer wins: writes slot and depth where candidate < depth.
  void (*depth_test)(const float* candidate, int lanes, std::uint32_t slot, float* depth, std::uint32_t* slots);
  /// Distance to the nearest edge in sub-texels, whose edge functions start `edges` doubles into each triangle's planes.
  LaneMask (*edge_distance)(const RunTriangles& run, int lanes, int edges, const Positions& at, FloatLanes& result);
  /// |u·size − offset − nearest integer|.
  LaneMask (*border_distance)(const Values& u, int lanes, int size, double offset, FloatLanes& result);
  /// Adds the squared differences of all four bytes of bilinear lookups, each rounded to a byte, and the wanted ones, of `count` <= 64 blocks, to `sum`.
  /// Bit n: a value of block n may be a tie, and nothing of it was added.
  LaneMask (*lookup_squares)(const std::byte* texels, std::uint32_t row_texels, const LookupBlocks& blocks, int count, std::uint64_t& sum);
  /// The same for kGroupTextures textures: texels of 3·kGroupTextures bytes, the R of all textures, then G, then B. Bit t of undecided[n]: nothing of
  /// block n was added to sums[t].
  void (*lookup_squares_of_group)(const std::byte* texels, std::uint32_t row_texels, const LookupBlocks& blocks, int count,
                                  std::uint64_t* sums, std::uint8_t* undecided);
  int vector_doubles;  ///< lanes of one vector
};

/// The kernels of a level; nullptr where this build or this machine has them not.
[[nodiscard]] const Kernels* kernels_for(SimdLevel level);

}  // namespace etalon::raster::fast
