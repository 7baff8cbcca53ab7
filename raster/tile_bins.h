// Which triangles can touch each tile of the frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/draw/draw_list.h"
#include "raster/visibility.h"

namespace etalon::raster {

class TileBins {
 public:
  /// Sorts the list's triangles by the tiles that hold a sample of their bounding boxes, on all threads; the result does not depend on them.
  TileBins(const DrawList& list, const Frame& frame);

  [[nodiscard]] std::size_t tiles() const { return first_.size() - 1; }
  [[nodiscard]] Tile tile(std::size_t n) const;
  /// Ids of the triangles of tile n, ascending.
  [[nodiscard]] std::span<const std::uint32_t> triangles(std::size_t n) const {
    return {ids_.get() + first_[n], first_[n + 1] - first_[n]};
  }

 private:
  int columns_, width_, height_;
  std::vector<std::size_t> first_;  ///< #tiles + 1, into ids_
  std::unique_ptr<std::uint32_t[]> ids_;
};

}  // namespace etalon::raster
