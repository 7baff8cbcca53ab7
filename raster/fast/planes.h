// A triangle as the vector kernels see it: attributes as planes over the texels of one tile, in doubles, each with one bound on its error.
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "core/draw/draw_list.h"
#include "raster/visibility.h"

namespace etalon::raster::fast {

// Numbers of one triangle, doubles, consecutive, in groups of four that kernels load and store together. Positions x, y are texels from the
// anchor, a texel of the tile in or near the triangle.
inline constexpr int kPlaneGroup = 4;
inline constexpr int kAnchorColumn = 0;  ///< of the anchor, from the tile's first texel
inline constexpr int kAnchorRow = 1;
inline constexpr int kErrorU = 2, kErrorV = 3;  ///< of the planes of u and v; other attributes' errors follow in groups of their own
inline constexpr int kQ = 4;                    ///< Q at the anchor, per column, per row, and 0: ΣE_i·w_j·w_k; 1, 0, 0 where affine
inline constexpr int kFirstPlane = 8;
// An attribute is base + (anchor + X·x + Y·y)/Q, within its error wherever a sample of the tile is inside the triangle.
inline constexpr int kPlaneBase = 0, kPlaneAnchor = 1, kPlaneX = 2, kPlaneY = 3;
/// The error of a plane that has none (exact_planes.h): value and value · image size are exact, nothing else is promised. Negative, and lost
/// against any value it is added to.
inline constexpr double kExactPlane = -0x1p-1000;

// An edge function: at the anchor, per column, per row, exact integers where kMostEdgeBits holds; and 1 / length of the edge in sub-texels.
inline constexpr int kEdgeAnchor = 0, kEdgeX = 1, kEdgeY = 2, kEdgeReciprocalLength = 3;
inline constexpr int kEdgeNumbers = kPlaneGroup;
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
    if (has(a)) return;
    offset_[a] = take_group();
    if (a <= kPlaneV) {
      error_[a] = a == kPlaneU ? kErrorU : kErrorV;
    } else {
      if (next_error_ % kPlaneGroup == 0) next_error_ = take_group();
      error_[a] = next_error_++;
    }
  }
  /// Room for the three edge functions, kEdgeNumbers each.
  void add_edges() {
    if (edges_ >= 0) return;
    edges_ = take_group();
    take_group(), take_group();
  }
  [[nodiscard]] int edges() const { return edges_; }  ///< −1: none
  [[nodiscard]] bool has(PlaneAttribute a) const { return offset_[a] >= 0; }
  [[nodiscard]] int offset(PlaneAttribute a) const { return offset_[a]; }
  [[nodiscard]] int error(PlaneAttribute a) const { return error_[a]; }  ///< place of the bound on a's error
  [[nodiscard]] int stride() const { return stride_; }

 private:
  int take_group() { return std::exchange(stride_, stride_ + kPlaneGroup); }
  std::array<int, kPlaneAttributes> offset_{}, error_{};
  int stride_ = kFirstPlane, edges_ = -1, next_error_ = 0;
};

/// Of one triangle. Writes layout.stride() numbers. `t` must have covered samples in the tile. Returns whether some Q is not 1.
bool make_planes(const DrawList& list, std::uint32_t t, const Frame& frame, const Tile& tile, const PlaneLayout& layout, double* out);

}  // namespace etalon::raster::fast
