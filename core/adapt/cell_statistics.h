// What the cells of a sequence are like: how many, how much of the paper's places they keep, why some splits have none.
#pragma once

#include <array>

#include "core/adapt/adapt_sequence.h"

namespace etalon::adapt {

struct CellStatistics {
  std::size_t splits = 0;
  /// Rings by CellStatus: one for an interior vertex, one for each side of a curve.
  std::array<std::size_t, kCellStatusCount> rings{};
  std::size_t cells = 0;
  /// Cells that are empty, or turned against the others of their ring, in one of both textures: exact, on the coordinates stored.
  std::size_t folded_cells = 0;
  std::size_t damped_places = 0, damped_crossings = 0;   ///< rings with cells in which u, or the crossings, keep less than all
  double mean_place_share = 1, mean_crossing_share = 1;  ///< over the rings with cells
  std::size_t memory_bytes = 0;
  [[nodiscard]] std::size_t made() const { return rings[static_cast<std::size_t>(CellStatus::made)]; }
};

/// Goes through all splits once.
[[nodiscard]] CellStatistics cell_statistics(const AdaptSequence& sequence);

}  // namespace etalon::adapt
