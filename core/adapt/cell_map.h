// The piecewise affine map between the textures before and after a collapse, without any resampling: the exact limit of adaptation.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/adapt/ring_cells.h"

namespace etalon::adapt {

enum class AdaptDirection : std::uint8_t {
  to_before,  ///< from the texture after the collapse to the one before it: what a texel of T^(i−1) shows, forward adaptation
  to_after,   ///< its inverse: backward adaptation
};

/// The image of texture coordinate `p`; nothing where no cell holds it. In double; for coordinates in [0, 1] a round trip errs by less than
/// 2^-46 over the least doubled area of the cells (tests/adapt/cell_map_test.cpp). On an edge of cells both give the same point up to
/// rounding; the lower cell is taken.
[[nodiscard]] std::optional<Vec2d> map_point(const RingCells& cells, AdaptDirection direction, const Vec2d& p);
/// The same of cells that are kept elsewhere: indices into `nodes`.
[[nodiscard]] std::optional<Vec2d> map_point(std::span<const CellNode> nodes, std::span<const std::array<std::uint16_t, 3>> cells,
                                             AdaptDirection direction, const Vec2d& p);

}  // namespace etalon::adapt
