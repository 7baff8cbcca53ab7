// The chain of cells between two levels, found by place: AdaptSequence::follow() for a whole map in seconds.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/adapt/adapt_sequence.h"

namespace etalon::adapt {

/// Texture space is cut into buckets, each with the ordered list of splits whose cells reach into it: a point meets only those. Memory:
/// the cells once more, 48 bytes for each side of a split, and 4 for each bucket that it reaches into.
class ChainIndex {
 public:
  /// Of the splits between two levels of the sequence (ETALON_CHECK), in either direction.
  ChainIndex(const AdaptSequence& sequence, std::size_t from, std::size_t to);

  /// The very double that sequence.follow(p, from, to) gives, for p in [0, 1]². May be called from several threads.
  [[nodiscard]] Vec2d follow(Vec2d p) const;

 private:
  // One side of a split: outside of this box map_point() finds nothing.
  struct Side {
    double x0, x1, y0, y1;
    std::uint32_t step, first_node;
    std::size_t first_cell;
  };
  [[nodiscard]] std::span<const CellNode> nodes_of(std::size_t side) const;
  [[nodiscard]] std::span<const std::array<std::uint16_t, 3>> cells_of(std::size_t side) const;
  [[nodiscard]] std::size_t bucket_of(const Vec2d& p) const;

  AdaptDirection direction_;
  std::vector<CellNode> nodes_;
  std::vector<std::array<std::uint16_t, 3>> cells_;
  std::vector<Side> sides_;                  // in the order of work, and an end
  std::vector<std::uint32_t> bucket_begin_;  // into side_of_, one more than buckets
  std::vector<std::uint32_t> side_of_;
};

}  // namespace etalon::adapt
