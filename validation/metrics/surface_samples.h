// Points spread over a surface: every vertex, along the edges, over the faces in proportion to area [Cignoni, Rocchini & Scopigno 1998, sec. 3].
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/vec.h"
#include "core/mesh/edge_list.h"
#include "core/mesh/mesh.h"

namespace etalon::validation {

/// One sample: its place and, where the mesh has colours, its colour, both interpolated in double.
struct SurfaceSample {
  Vec3d point{0, 0, 0};
  Vec3d color{0, 0, 0};
};

/// Which points, decided once: about `target` of them. Every vertex that a face uses is one; what is left of the target is shared out: with s
/// samples to a unit of area, inner points of edges √s to a unit of length, evenly spaced, and the rest over the faces by area. The points
/// inside faces are a low-discrepancy sequence: no random numbers, the same points everywhere. Where the vertices alone pass
/// the target they are all there is. Does not weight: every sample counts alike, as Metro has it.
class SurfaceSamples {
 public:
  /// InputError where the mesh has no faces, an index is out of range or a position is not finite. The mesh must outlive this.
  SurfaceSamples(const Mesh& mesh, std::uint64_t target);

  [[nodiscard]] std::uint64_t vertex_count() const { return vertices_.size(); }
  [[nodiscard]] std::uint64_t edge_count() const { return edge_ends_.empty() ? 0 : edge_ends_.back(); }
  [[nodiscard]] std::uint64_t face_count() const { return face_ends_.empty() ? 0 : face_ends_.back(); }
  [[nodiscard]] std::uint64_t count() const { return vertex_count() + edge_count() + face_count(); }

  /// Samples come in blocks that do not depend on threads; neighbours in a block are mostly neighbours in space.
  [[nodiscard]] std::size_t block_count() const;
  /// Appends the samples of a block, in their order.
  void append_block(std::size_t block, std::vector<SurfaceSample>& samples) const;

 private:
  void append_vertex(std::uint32_t vertex, std::vector<SurfaceSample>& samples) const;
  void append_edge(std::size_t edge, std::vector<SurfaceSample>& samples) const;
  void append_face(std::size_t face, std::vector<SurfaceSample>& samples) const;
  [[nodiscard]] SurfaceSample blend(const std::array<std::uint32_t, 3>& vertices, const Vec3d& weights) const;

  const Mesh& mesh_;
  std::vector<std::uint32_t> vertices_;
  std::vector<VertexPair> edges_;
  std::vector<std::uint64_t> edge_ends_;  // samples of edges up to and including this one
  std::vector<std::uint64_t> face_ends_;
};

}  // namespace etalon::validation
