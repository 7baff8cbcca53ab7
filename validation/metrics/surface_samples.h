// Points spread over a surface: every vertex, along the edges, over the faces in proportion to area [Cignoni, Rocchini & Scopigno 1998, sec. 3].
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/vec.h"
#include "core/mesh/edge_list.h"
#include "core/mesh/mesh.h"

namespace etalon::validation {

/// Samples in a block; the last one may hold fewer. Figures are sums over blocks, so it is part of their definition.
inline constexpr std::uint64_t kBlockSamples = 4096;

/// Some samples: their places and, where the mesh has colours, their colours; both interpolated in double.
struct SampleBlock {
  std::vector<Vec3d> points;
  std::vector<Vec3d> colors;  ///< as many as points, or none
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

  /// Samples are numbered: vertices in order, then edges in order and along each, then faces. Block b holds those from b·kBlockSamples on.
  [[nodiscard]] std::size_t block_count() const { return static_cast<std::size_t>((count() + kBlockSamples - 1) / kBlockSamples); }
  [[nodiscard]] SampleBlock block(std::size_t b) const;

 private:
  void add_edge(std::size_t edge, std::uint64_t begin, std::uint64_t end, SampleBlock& block) const;
  void add_face(std::size_t face, std::uint64_t begin, std::uint64_t end, SampleBlock& block) const;
  void add(const std::array<std::uint32_t, 3>& vertices, const Vec3d& weights, SampleBlock& block) const;

  const Mesh& mesh_;
  std::vector<std::uint32_t> vertices_;
  std::vector<VertexPair> edges_;
  std::vector<std::uint64_t> edge_ends_;  // samples of edges up to and including this one
  std::vector<std::uint64_t> face_ends_;
};

}  // namespace etalon::validation
