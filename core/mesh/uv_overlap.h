// How much of a texture is claimed by more than one face.
#pragma once

#include "core/mesh/mesh.h"

namespace etalon {

struct UvOverlap {
  int grid = 0;                      ///< cells on a side of [0, 1]²
  std::size_t covered_cells = 0;     ///< whose centre lies in at least one face
  std::size_t overlapped_cells = 0;  ///< … in at least two
  std::size_t face_count = 0;        ///< faces that share a cell with another face
  std::vector<FaceId> first_faces;   ///< the lowest of them
  [[nodiscard]] double share() const {
    return covered_cells == 0 ? 0 : static_cast<double>(overlapped_cells) / static_cast<double>(covered_cells);
  }
};

/// Draws all faces in texture space on a grid × grid raster of [0, 1]², corners rounded to 1/256 cell, coverage in integers with a fill
/// rule under which faces that share an edge never share a cell. What lies outside [0, 1]² is cut off; faces with a corner beyond ±1024,
/// not finite, or without area on the grid are left out. grid: 1..2048. At most `list_limit` faces are listed. Memory: 6 bytes a cell, 28 a
/// face. Time: at most some steps a cell and one a row of each different triangle, however often faces cover each other.
[[nodiscard]] UvOverlap measure_uv_overlap(const Mesh& mesh, int grid, std::size_t list_limit);

}  // namespace etalon
