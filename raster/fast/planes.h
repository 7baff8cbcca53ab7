// A triangle as the vector kernels see it: attributes as planes over the texels of one tile, in doubles, each with one bound on its error.
#pragma once

#include <array>
#include <vector>

#include "core/draw/draw_list.h"
#include "raster/visibility.h"

namespace etalon::raster::fast {

// Numbers of one triangle, doubles, consecutive. Positions x, y are texels from the anchor, a texel of the tile in or near the triangle.
inline constexpr int kAnchorColumn = 0;  ///< of the anchor, from the tile's first texel
inline constexpr int kAnchorRow = 1;
inline constexpr int kQ = 2;  ///< Q at the anchor, per column, per row: ΣE_i·w_j·w_k; 1, 0, 0 where affine
inline constexpr int kFirstPlane = 5;
// An attribute is base + (anchor + X·x + Y·y)/Q, within error wherever a sample of the tile is inside the triangle.
inline constexpr int kPlaneBase = 0, kPlaneAnchor = 1, kPlaneX = 2, kPlaneY = 3, kPlaneError = 4;
inline constexpr int kPlaneNumbers = 5;
/// The error of a plane that has none (exact_planes.h): value and value · image size are exact, nothing else is promised. Negative, and lost
/// against any value it is added to.
inline constexpr double kExactPlane = -0x1p-1000;

// An edge function: at the anchor, per column, per row, exact integers where kMostEdgeBits holds; and 1 / length of the edge in sub-texels.
inline constexpr int kEdgeAnchor = 0, kEdgeX = 1, kEdgeY = 2, kEdgeReciprocalLength = 3;
inline constexpr int kEdgeNumbers = 4;
/// Sub-texel bits up to which edge functions, and every partial sum of theirs in a tile, stay below 2^53: 2·2^(2·(14 + 11)) = 2^51.
inline constexpr int kMostEdgeBits = 11;

/// Attributes that a plane can carry, and the place each has among those asked for.
enum PlaneAttribute : std::uint8_t {
  kPlaneU,
  kPlaneV,
  kPlaneRed,
  kPlaneGreen,
  kPlaneBlue,
  kPlaneAlpha,
  kPlaneWeight0,
  kPlaneWeight1,
  kPlaneWeight2,
  kPlaneAttributes
};

class PlaneLayout {
 public:
  PlaneLayout() { offset_.fill(-1); }
  void add(PlaneAttribute a) {
    if (offset_[a] < 0) offset_[a] = stride_, stride_ += kPlaneNumbers;
  }
  /// Room for the three edge functions, kEdgeNumbers each.
  void add_edges() {
    if (edges_ < 0) edges_ = stride_, stride_ += 3 * kEdgeNumbers;
  }
  [[nodiscard]] int edges() const { return edges_; }  ///< −1: none
  [[nodiscard]] bool has(PlaneAttribute a) const { return offset_[a] >= 0; }
  [[nodiscard]] int offset(PlaneAttribute a) const { return offset_[a]; }
  [[nodiscard]] int stride() const { return stride_; }

 private:
  std::array<int, kPlaneAttributes> offset_{};
  int stride_ = kFirstPlane, edges_ = -1;
};

/// Writes layout.stride() numbers. `t` must have covered samples in the tile. Returns whether some Q is not 1.
bool make_planes(const DrawList& list, std::uint32_t t, const Frame& frame, const Tile& tile, const PlaneLayout& layout, double* out);

}  // namespace etalon::raster::fast
