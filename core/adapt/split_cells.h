// The cells of one vertex split of a progressive mesh, chart by chart.
#pragma once

#include <vector>

#include "core/adapt/ring_cells.h"
#include "core/progressive/progressive_mesh.h"

namespace etalon::adapt {

/// Why a split has no cells on one side of its curve.
enum class CellStatus : std::uint8_t {
  made,
  fold,      ///< a triangle of the ring is turned against the others in the texture plane, or has no area there
  no_place,  ///< make_ring_cells() found no positive cells
  gone,      ///< on a curve: no triangle is left after the collapse
};

/// The cells on one side of u's curve, or all around u: in texture coordinates as they are, so those of a mirrored chart are clockwise.
struct ChartCells {
  CellStatus status = CellStatus::made;
  RingCells cells;  ///< empty unless made
};

/// One for an interior vertex, one or two for a vertex on a curve. `mesh` has to be at level split + 1 at least (ETALON_CHECK) and at most
/// there; it must have texture coordinates.
[[nodiscard]] std::vector<ChartCells> cells_of_split(const progressive::ProgressiveMesh& mesh, std::size_t split);

}  // namespace etalon::adapt
