// The loops of the fast path over one run of texels of a tile's row, compiled once per instruction set (kernels.cpp). They decide only
// where a bound proves them right, and say where not. Bounds are derived where they are formed: planes.cpp and the .inc files.
#pragma once

#include <array>
#include <cstdint>

#include "core/draw/state.h"
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
struct alignas(64) OffsetLanes {
  std::int64_t at[kRunLanes];
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

/// The triangles of a run: planes (planes.h) and, per lane, the offset of its triangle's.
struct RunTriangles {
  const double* planes;
  const OffsetLanes* offset;
  bool uniform;      ///< all lanes have one offset
  bool perspective;  ///< some Q is not 1
};

/// The texels of an image that a lookup names.
struct TexelGrid {
  int width, height;
  Wrap wrap_u, wrap_v;
};

/// The edge functions of a triangle over a box of texels, biased so that inside is >= 0: at the first texel, per column, per row.
/// Nothing exceeds 2^31 at the box's columns 0..7.
struct SmallTriangle {
  std::int32_t value[3], x[3], y[3];
};

struct Kernels {
  /// Bit i of rows[j]: texel (i, j) of the box is inside; 8 columns.
  void (*cover_small)(const SmallTriangle& triangle, int row_count, std::uint8_t* rows);
  /// How many of the first `count` numbers (1..64) equal the first.
  int (*equal_run)(const std::uint32_t* numbers, int count);
  /// Positions of texels (column + lane, row), relative to the tile.
  void (*positions)(const RunTriangles& run, int lanes, int column, int row, Positions& result);
  /// The attribute whose plane starts `attribute` doubles into each triangle's planes.
  void (*attribute)(const RunTriangles& run, int lanes, int attribute, const Positions& at, Values& result);
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
  /// Bilinear value of one channel, in the texels' unit, times `scale`; |t| <= largest over the whole image.
  void (*bilinear)(const DoubleLanes t[4], const LinearAxis& u, const LinearAxis& v, int lanes, double scale, double largest,
                   Values& result);
  /// The same for four channels of unorm8 texels of four bytes at once; values in [0, 1].
  void (*bilinear_rgba8)(const std::byte* texels, const IntLanes offset[4], const LinearAxis& u, const LinearAxis& v, int lanes,
                         Values result[4]);
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
  int vector_doubles;  ///< lanes of one vector
};

/// The kernels of a level; nullptr where this build or this machine has them not.
[[nodiscard]] const Kernels* kernels_for(SimdLevel level);

}  // namespace etalon::raster::fast
