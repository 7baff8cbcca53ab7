// Who touches whom: edges and their faces, opposite half-edges, faces around a vertex, boundary loops, connected components.
#pragma once

#include <span>

#include "core/mesh/mesh.h"

namespace etalon {

using EdgeId = StrongId<struct EdgeTag>;
/// Half-edge 3·face + corner runs from that corner to the next one of its face, the face on its left.
using HalfEdgeId = StrongId<struct HalfEdgeTag>;

/// An immutable picture of a mesh's connections; the mesh must outlive it and must not change. Its nodes are the vertices, or the wedges:
/// then an edge is shared only where both faces use the same two wedges, that is, where texture coordinates continue. Every order is by
/// lowest index first. All is O(faces) but the sort of the half-edges.
class Adjacency {
 public:
  enum class Nodes { vertices, wedges };
  /// ETALON_CHECKs that all indices are in range.
  explicit Adjacency(const Mesh& mesh, Nodes nodes = Nodes::vertices);

  [[nodiscard]] std::size_t node_count() const { return face_starts_.size() - 1; }
  [[nodiscard]] std::size_t edge_count() const { return edge_starts_.size() - 1; }
  [[nodiscard]] std::size_t half_edge_count() const { return edge_of_.size(); }

  [[nodiscard]] static HalfEdgeId half_edge(FaceId f, int corner) { return HalfEdgeId(3 * f.index + static_cast<std::uint32_t>(corner)); }
  [[nodiscard]] static FaceId face(HalfEdgeId h) { return FaceId(h.index / 3); }
  [[nodiscard]] static int corner(HalfEdgeId h) { return static_cast<int>(h.index % 3); }
  [[nodiscard]] static HalfEdgeId next(HalfEdgeId h) { return HalfEdgeId(h.index % 3 == 2 ? h.index - 2 : h.index + 1); }
  [[nodiscard]] static HalfEdgeId previous(HalfEdgeId h) { return HalfEdgeId(h.index % 3 == 0 ? h.index + 2 : h.index - 1); }

  /// Node (vertex or wedge index) at the start of a half-edge.
  [[nodiscard]] std::uint32_t start(HalfEdgeId h) const { return nodes_[h.index]; }
  [[nodiscard]] std::uint32_t end(HalfEdgeId h) const { return nodes_[next(h).index]; }

  /// The edge a half-edge lies on; invalid where both its ends are the same node.
  [[nodiscard]] EdgeId edge(HalfEdgeId h) const { return edge_of_[h.index]; }
  /// All half-edges on an edge, in either direction: 1 on a boundary, 2 inside a manifold, more where it is not one.
  [[nodiscard]] std::span<const HalfEdgeId> half_edges(EdgeId e) const {
    return {on_edges_.data() + edge_starts_[e.index], edge_starts_[e.index + 1] - edge_starts_[e.index]};
  }
  /// The half-edge of the one other face, where the edge has exactly two faces and they run against each other; invalid otherwise.
  [[nodiscard]] HalfEdgeId opposite(HalfEdgeId h) const;
  [[nodiscard]] bool on_boundary(HalfEdgeId h) const { return edge(h).valid() && half_edges(edge(h)).size() == 1; }

  /// Faces that use a node, each once, ascending.
  [[nodiscard]] std::span<const FaceId> faces_around(std::uint32_t node) const {
    return {around_.data() + face_starts_[node], face_starts_[node + 1] - face_starts_[node]};
  }

  /// Half-edges of the boundary, chained into loops; each loop starts at its lowest half-edge, loops ascend by it. At a node where several
  /// boundaries meet a loop continues around the face it came from; where that fails (a non-manifold edge) at the lowest free half-edge.
  [[nodiscard]] std::vector<std::vector<HalfEdgeId>> boundary_loops() const;

  struct Components {
    std::vector<std::uint32_t> of_face;  ///< #F
    std::uint32_t count = 0;             ///< numbered by their lowest face
  };
  /// Faces connected over shared edges, however many faces an edge has.
  [[nodiscard]] Components face_components() const;

 private:
  [[nodiscard]] HalfEdgeId next_on_boundary(HalfEdgeId h) const;

  std::vector<std::uint32_t> nodes_;        // #H
  std::vector<EdgeId> edge_of_;             // #H
  std::vector<HalfEdgeId> on_edges_;        // grouped by edge
  std::vector<std::uint32_t> edge_starts_;  // #E + 1
  std::vector<FaceId> around_;              // grouped by node
  std::vector<std::uint32_t> face_starts_;  // #N + 1
};

}  // namespace etalon
