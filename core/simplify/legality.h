// Which collapses keep a mesh a mesh: topology, curves, no triangle turned over in space or in texture space.
#pragma once

#include <array>

#include "core/simplify/moved_vertex.h"
#include "core/simplify/unit_positions.h"

namespace etalon::simplify {

/// Why a collapse is refused; the first that applies, in this order.
enum class Refusal : std::uint8_t {
  none,
  link,             ///< the link condition [Dey et al. 1999]: the surface would touch or pass through itself combinatorially
  last_faces,       ///< a tetrahedron, or a single triangle, would vanish
  curve,            ///< two curves would become one: a chart, a hole or a material's piece of one triangle's width would close
  flip_in_space,    ///< a face would turn by more than the limit, or lose its area
  flip_in_texture,  ///< a face would be against its chart's orientation, or without area, in texture space; a fold may only be healed
  tolerance,        ///< a vertex of the input would be farther from the surface than asked for
};
inline constexpr std::size_t kRefusalCount = 7;
/// "link_condition", "last_faces", …: as documents name them.
[[nodiscard]] const char* to_string(Refusal refusal);

struct LegalityOptions {
  /// Least cosine between the normals of a face before and after one collapse, in [0, 1).
  double min_normal_cosine = 0.2;
};

/// Judges collapses of vertices to neighbours along edges that their kinds allow. Signs in texture space are exact. Holds marks of
/// its own: one judge, one thread.
class Legality {
 public:
  Legality(const CollapseMesh& mesh, const UnitPositions& positions, const LegalityOptions& options)
      : mesh_(mesh), places_(positions.at), options_(options), marks_(mesh.source().vertex_count(), 0) {}

  /// u → the other end of `edge`, which is edge_from(u, …).
  [[nodiscard]] Refusal check(std::uint32_t u, const CollapseMesh::Edge& edge);
  /// The full-edge collapse of `edge`, edge_from(u, …), to v as moved: the same, and no face of v turned over either.
  [[nodiscard]] Refusal check_move(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge, const MovedVertex& moved);
  /// Whether w was a neighbour of u in the collapse found legal last, before it was done.
  [[nodiscard]] bool was_near(std::uint32_t w) const { return marks_[mesh_.origin(w)] == current_; }

 private:
  [[nodiscard]] Refusal check_topology(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge);
  [[nodiscard]] bool link_holds(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge);
  [[nodiscard]] bool last_faces(std::uint32_t u, std::uint32_t v, const CollapseMesh::Edge& edge) const;
  [[nodiscard]] bool closes_curve(const CollapseMesh::Edge& edge) const;
  [[nodiscard]] bool flips_in_space(std::uint32_t w, const Vec3f& to, const CollapseMesh::Edge& edge) const;
  [[nodiscard]] bool flips_in_texture(std::uint32_t w, const CollapseMesh::Edge& edge, const Vec2f* left, const Vec2f* right) const;

  const CollapseMesh& mesh_;
  const std::vector<Vec3f>& places_;
  LegalityOptions options_;
  std::vector<std::uint32_t> marks_;  // by vertex of the source: the check that saw it last
  std::uint32_t current_ = 0;
};

}  // namespace etalon::simplify
