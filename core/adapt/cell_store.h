// The cells of many splits in one array: what a collapse costs in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/adapt/split_cells.h"

namespace etalon::adapt {

/// Cells by split, packed: a node that is at the same place in both textures is kept once, a cell is three bytes while its nodes are at most
/// 256. What is read back equals what was put in, bit for bit.
class CellStore {
 public:
  explicit CellStore(std::size_t splits = 0) : start_(splits, kEmpty) {}

  [[nodiscard]] std::size_t size() const { return start_.size(); }
  /// Each split once (ETALON_CHECK); shares of kPlaceShares and kCrossingShares only (ETALON_CHECK).
  void put(std::size_t split, const std::vector<ChartCells>& charts);
  /// Empty for a split that has none. `charts` is overwritten; its memory is used again.
  void read(std::size_t split, std::vector<ChartCells>& charts) const;
  /// Gives back memory that growing has left over.
  void shrink() { bytes_.shrink_to_fit(); }
  [[nodiscard]] std::size_t memory_bytes() const { return bytes_.capacity() + start_.capacity() * sizeof(std::size_t); }

 private:
  static constexpr std::size_t kEmpty = static_cast<std::size_t>(-1);
  std::vector<std::size_t> start_;  // in bytes_, by split
  std::vector<std::byte> bytes_;
};

/// Where a share stands in kPlaceShares or kCrossingShares (ETALON_CHECK that it does).
[[nodiscard]] std::uint8_t index_of_place_share(double share);
[[nodiscard]] std::uint8_t index_of_crossing_share(double share);

}  // namespace etalon::adapt
