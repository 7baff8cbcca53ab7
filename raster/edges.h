// Coverage, exact: the edge functions of one triangle and who owns a sample that lies on them (docs/contract.md#coverage).
#pragma once

#include <array>
#include <cstdint>

#include "core/draw/draw_list.h"

namespace etalon::raster {

/// Values of the three edge functions at a sample; edge i lies opposite vertex i. All >= 0 inside.
using EdgeValues = std::array<std::int64_t, 3>;

/// The edge functions of a triangle, counter-clockwise whatever the input order. With the input's ranges |E| < 2^62:
/// frame + 2·guard <= 2^14 texels of at most 2^16 sub-texels, so |dx|, |dy|, |px − a.x| < 2^30 and each product < 2^60.
/// The arrays are set where area2 is not 0.
struct Edges {
  std::array<std::int64_t, 3> dx, dy;  ///< along the edge, sub-texels
  std::array<std::int64_t, 3> c;       ///< E(px, py) = dx·py − dy·px + c
  std::array<bool, 3> owns;            ///< whether E = 0 counts as inside
  std::int64_t area2 = 0;              ///< twice the area = ΣE; 0: nothing to draw (degenerate or culled)
  int i_min = 0, i_max = -1;           ///< texel columns and rows whose centres lie in the bounding box, inside the frame
  int j_min = 0, j_max = -1;
  int subtexel_bits = 8;

  [[nodiscard]] std::int64_t sample_subtexel(int texel) const {
    return ((2 * static_cast<std::int64_t>(texel)) + 1) << (subtexel_bits - 1);
  }
  [[nodiscard]] EdgeValues at(int i, int j) const {
    const std::int64_t px = sample_subtexel(i), py = sample_subtexel(j);
    return {dx[0] * py - dy[0] * px + c[0], dx[1] * py - dy[1] * px + c[1], dx[2] * py - dy[2] * px + c[2]};
  }
  [[nodiscard]] bool inside(const EdgeValues& e) const {
    return (e[0] > 0 || (e[0] == 0 && owns[0])) && (e[1] > 0 || (e[1] == 0 && owns[1])) && (e[2] > 0 || (e[2] == 0 && owns[2]));
  }
  /// The columns of row j that can be inside, by exact division per edge; empty (first > second) where none.
  [[nodiscard]] std::array<int, 2> span(int j) const;
};

/// Edges of a triangle on a frame; area2 = 0 and an empty box where it draws nothing.
[[nodiscard]] Edges make_edges(const RasterVertex& v0, const RasterVertex& v1, const RasterVertex& v2, const Frame& frame);

}  // namespace etalon::raster
