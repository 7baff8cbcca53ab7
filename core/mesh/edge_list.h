// The edges of a mesh as pairs of vertices, without their faces.
#pragma once

#include "core/mesh/mesh.h"

namespace etalon {

struct VertexPair {
  std::uint32_t low = 0, high = 0;
  friend auto operator<=>(const VertexPair&, const VertexPair&) = default;
};

/// Every edge of at least one face, once, ascending; sides whose ends are one vertex are left out. O(faces · log(valence)). ETALON_CHECKs that indices
/// are in range.
[[nodiscard]] std::vector<VertexPair> unique_edges(const Mesh& mesh);

}  // namespace etalon
