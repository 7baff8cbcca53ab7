// The cells of all splits of a progressive mesh, and the order in which a map goes through them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/adapt/cell_map.h"
#include "core/adapt/cell_store.h"

namespace etalon::adapt {

class AdaptSequence {
 public:
  /// Goes once from the finest level to the base. The mesh needs texture coordinates (InputError) and is left at its base. `progress` hears of
  /// splits done and in all about every 1,000; an exception of it stops the work.
  explicit AdaptSequence(progressive::ProgressiveMesh& mesh, const std::function<void(std::size_t, std::size_t)>& progress = {});
  /// Cells that were made before, of each split of their mesh.
  explicit AdaptSequence(CellStore cells) : cells_(std::move(cells)) { cells_.shrink(); }

  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  /// Of split n, which leads from level n to level n + 1.
  [[nodiscard]] std::vector<ChartCells> split(std::size_t n) const;
  /// The same, with the memory of `charts`.
  void read(std::size_t n, std::vector<ChartCells>& charts) const { cells_.read(n, charts); }
  [[nodiscard]] std::size_t memory_bytes() const { return cells_.memory_bytes(); }

  /// Where texture coordinate p of level `from` lies at level `to`: through the cells of all splits between, without resampling. The exact
  /// limit of what adapting maps can give.
  [[nodiscard]] Vec2d follow(Vec2d p, std::size_t from, std::size_t to) const;

 private:
  CellStore cells_;
};

/// The splits between two levels in the order of work (downward from the finer, upward from the coarser), in packs whose regions do not touch:
/// all of a pack can be adapted at once and give what one by one gives. A split joins a pack only if its region overlaps neither one in the
/// pack nor one passed over before it: the paper's rule (sec. 4) forgets the latter and lets regions overtake others that they depend on.
/// Regions are the texels, of a map of width × height, of the cells' bounding box in both textures and `reach` texels around: what a lookup
/// there may read or write. Splits without cells are in no pack.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> pack_splits(const AdaptSequence& sequence, std::size_t from, std::size_t to,
                                                                  int width, int height, int reach = 1);

/// How many packs the rule as printed makes of the same splits and regions: there a region passed over holds back none after it. To compare
/// with the paper's numbers only; those packs give another map.
[[nodiscard]] std::size_t count_printed_packs(const AdaptSequence& sequence, std::size_t from, std::size_t to, int width, int height,
                                              int reach = 1);

}  // namespace etalon::adapt
