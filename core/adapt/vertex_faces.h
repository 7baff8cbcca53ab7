// Which faces are around each vertex of a progressive mesh, on the way from its finest level down.
#pragma once

#include <cstdint>
#include <vector>

#include "core/progressive/progressive_mesh.h"

namespace etalon::adapt {

class VertexFaces {
 public:
  /// Of the mesh at its current level; nothing is kept (and of() must not be asked) where it has no moves: half-edge collapses need it not.
  explicit VertexFaces(const progressive::ProgressiveMesh& mesh);

  /// From level split + 1 to level split.
  void coarsen(const progressive::ProgressiveMesh& mesh, std::size_t split);

  /// By appearance, in no order that means anything, but the same on every machine.
  [[nodiscard]] const std::vector<std::uint32_t>& of(std::uint32_t vertex) const { return faces_[vertex]; }

 private:
  std::vector<std::vector<std::uint32_t>> faces_;
};

}  // namespace etalon::adapt
