// Where every vertex of the scan belongs on the simplified mesh, when no tolerance has to be kept on the way.
#pragma once

#include <cstdint>

#include "core/mesh/landing.h"
#include "core/simplify/simplify.h"

namespace etalon::bake {

/// Which vertex took in which, while a mesh is simplified: what makes the mapping of [Soucy, Godin & Rioux 1996, sec. 1] stay in its
/// neighbourhood, at a store for each collapse. Following every vertex over the surface at each collapse takes longer than the collapses.
class CollapseTrail {
 public:
  /// Vertices of the mesh to be simplified.
  explicit CollapseTrail(std::size_t vertex_count) : into_(vertex_count, simplify::kNone) {}

  /// For SimplifyOptions::before_collapse.
  void record(const simplify::CollapseMesh& mesh, const simplify::CollapseEvent& event) {
    into_[mesh.origin(event.u)] = mesh.origin(event.v);
  }
  /// By vertex: the vertex of `result` that took it in at last, itself where it is still there; kNone for a vertex that had no face.
  [[nodiscard]] std::vector<std::uint32_t> survivors(const simplify::SimplifyResult& result) const;

 private:
  std::vector<std::uint32_t> into_;
};

/// By vertex of the scan, on result.mesh: from the triangles around its survivor on to neighbouring ones (those that share a vertex with the
/// nearest so far) as long as one of them is nearer, and there the nearest point; of equally near triangles the lowest, but never
/// those of another vertex at the survivor's place instead of its own. So a landing is
/// connected with where the collapses took its vertex, whatever other parts of the surface pass near it. A vertex that is still there and
/// was not moved lands on itself, in its lowest face. Linear in vertices, in parallel; the same for every thread count.
[[nodiscard]] std::vector<Landing> land_vertices(const Mesh& scan, const simplify::SimplifyResult& result, const CollapseTrail& trail);

/// Largest distance of a vertex to its landing, model units: no vertex is farther from `mesh`.
[[nodiscard]] double largest_distance(const Mesh& scan, const Mesh& mesh, const std::vector<Landing>& landings);

}  // namespace etalon::bake
