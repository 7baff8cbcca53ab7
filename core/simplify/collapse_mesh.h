// The connectivity that half-edge collapses change: triangles in flat arrays, each half-edge knowing the one across it.
// Does not: judge a collapse (legality.h), price it (qem_metric.h), or choose where a vertex moves (placement.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/mesh_validation.h"

namespace etalon::simplify {

/// No vertex, no half-edge. Engine ids are plain indices: they are the payload of the inner loops.
inline constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// Where a vertex may go. A curve is a chain of edges at which something ends: the surface, texture coordinates, a material.
enum class VertexKind : std::uint8_t {
  interior,  ///< no curve edge: may collapse into any neighbour
  curve,     ///< two curve edges: may collapse along them only
  locked,    ///< any other number, a vertex at which the surface is no manifold, or locked by the caller: stays
};

/// What was wrong with the input, and what was done about it: nothing of it changes a position.
struct InputRepair {
  Defect repeated_corners;       ///< faces that name a vertex twice: dropped
  Defect duplicate_faces;        ///< faces that repeat an earlier one, in the same direction: dropped
  Defect non_manifold_edges;     ///< lowest faces at an edge of three or more faces: the edge is cut, its ends locked
  Defect inconsistent_edges;     ///< lowest faces at an edge that both its faces run along in the same direction: cut, ends locked
  Defect non_manifold_vertices;  ///< vertices whose faces do not form one fan: locked
  Defect unreferenced_vertices;  ///< vertices of no face: left out of the result
  Defect color_seam_vertices;    ///< boundary vertices that share their place with another colour: they stay
  [[nodiscard]] bool non_manifold() const {
    return non_manifold_edges.found() || inconsistent_edges.found() || non_manifold_vertices.found();
  }
};

/// The triangles. Half-edge 4·face + corner runs from that corner to the next one of its face, the face on its left.
///
/// A vertex whose faces form several fans is several engine vertices, each locked, that share a place: the first keeps the mesh's index,
/// the
/// others are numbered from the mesh's vertex count on (origin() leads back). So every engine vertex has one fan, which is all that
/// a collapse needs, and the mesh stays joined where it was.
class CollapseMesh {
 public:
  /// `locked`: vertices to keep, each below vertex_count(). All indices of the mesh must be in range, uv finite (ETALON_CHECK).
  CollapseMesh(const Mesh& mesh, const std::vector<VertexId>& locked);

  [[nodiscard]] const Mesh& source() const { return *source_; }
  [[nodiscard]] const InputRepair& repair() const { return repair_; }
  [[nodiscard]] std::uint32_t vertex_capacity() const { return static_cast<std::uint32_t>(out_.size()); }
  [[nodiscard]] std::uint32_t face_capacity() const { return static_cast<std::uint32_t>(faces_.size()); }
  [[nodiscard]] std::uint32_t face_count() const { return face_count_; }

  [[nodiscard]] static std::uint32_t next(std::uint32_t h) { return (h & 3) == 2 ? h - 2 : h + 1; }
  [[nodiscard]] static std::uint32_t previous(std::uint32_t h) { return (h & 3) == 0 ? h + 2 : h - 1; }
  [[nodiscard]] std::uint32_t start(std::uint32_t h) const { return faces_[h >> 2].vertex[h & 3]; }
  [[nodiscard]] std::uint32_t end(std::uint32_t h) const { return start(next(h)); }
  /// The half-edge across; kNone on a boundary and at an edge that was cut.
  [[nodiscard]] std::uint32_t opposite(std::uint32_t h) const { return faces_[h >> 2].opposite[h & 3]; }
  [[nodiscard]] bool on_curve(std::uint32_t h) const { return (faces_[h >> 2].flags >> (h & 3)) & 1u; }
  [[nodiscard]] bool face_alive(std::uint32_t f) const { return faces_[f].flags & kAlive; }
  [[nodiscard]] bool vertex_alive(std::uint32_t v) const { return out_[v] != kNone; }
  /// Sign that the face must keep in texture space: that of its chart; 0 without uv, and in a chart of under one texel.
  [[nodiscard]] int uv_sign(std::uint32_t f) const { return static_cast<int>((faces_[f].flags >> kUvShift) & 3u) - 1; }
  [[nodiscard]] VertexKind kind(std::uint32_t v) const { return kinds_[v]; }
  [[nodiscard]] std::uint32_t origin(std::uint32_t v) const {
    return v < source_->vertex_count() ? v : extra_origin_[v - source_->vertex_count()];
  }
  [[nodiscard]] const Vec3f& position(std::uint32_t v) const { return (moves_ ? positions_ : source_->positions)[origin(v)]; }
  /// Calls visit(w) for every engine vertex at the source's vertex that v is at, v among them.
  template <class Visit>
  void for_each_fan(std::uint32_t v, const Visit& visit) const {
    if (extra_origin_.empty()) return visit(v);
    const std::uint32_t at = origin(v);
    visit(at);
    for (auto extra = std::lower_bound(extra_origin_.begin(), extra_origin_.end(), at); extra != extra_origin_.end() && *extra == at;
         ++extra)
      visit(static_cast<std::uint32_t>(source_->vertex_count() + static_cast<std::size_t>(extra - extra_origin_.begin())));
  }
  /// Only where the source has colours.
  [[nodiscard]] const Vec4f& color(std::uint32_t v) const { return (moves_ ? colors_ : source_->colors)[origin(v)]; }
  /// Wedge at the start of a half-edge.
  [[nodiscard]] std::uint32_t wedge(std::uint32_t h) const { return wedges_[h]; }
  [[nodiscard]] bool textured() const { return !wedges_.empty(); }
  /// Texture coordinate of a wedge, by its index in the source.
  [[nodiscard]] const Vec2f& uv_of_wedge(std::uint32_t w) const { return moves_ ? uvs_[w] : source_->wedges[w].uv; }
  [[nodiscard]] const Vec2f& uv(std::uint32_t h) const { return uv_of_wedge(wedges_[h]); }

  /// From now on positions, colours and texture coordinates are this mesh's own and may be moved: 12 to 36 bytes a vertex.
  void allow_moves();
  void move(std::uint32_t v, const Vec3f& position) { positions_[origin(v)] = position; }
  void set_color(std::uint32_t v, const Vec4f& color) { colors_[origin(v)] = color; }
  void set_uv(std::uint32_t wedge, const Vec2f& uv) { uvs_[wedge] = uv; }
  [[nodiscard]] bool moves_allowed() const { return moves_; }

  /// First outgoing half-edge, counter-clockwise; on a boundary the one without a face on its right.
  [[nodiscard]] std::uint32_t first_out(std::uint32_t v) const { return out_[v]; }
  /// The outgoing half-edge of the next face counter-clockwise; kNone behind the last face of an open fan.
  [[nodiscard]] std::uint32_t rotate(std::uint32_t h) const { return opposite(previous(h)); }
  [[nodiscard]] bool on_boundary(std::uint32_t v) const { return opposite(out_[v]) == kNone; }

  /// Calls visit(neighbour, half-edge on the edge to it), counter-clockwise; the half-edge leaves v, except for the last neighbour of an
  /// open fan.
  template <class Visit>
  void for_each_neighbor(std::uint32_t v, const Visit& visit) const {
    const std::uint32_t first = out_[v];
    std::uint32_t h = first;
    do {
      visit(end(h), h);
      const std::uint32_t back = previous(h);
      h = opposite(back);
      if (h == kNone) {
        visit(start(back), back);
        return;
      }
    } while (h != first);
  }

  /// The two sides of an edge u-v: u→v with its face on the left, v→u with the face on the right; kNone where there is none.
  struct Edge {
    std::uint32_t left = kNone, right = kNone;
    [[nodiscard]] int face_count() const { return (left != kNone ? 1 : 0) + (right != kNone ? 1 : 0); }
  };
  /// The edge that half-edge h is on, seen from u, one of its ends.
  [[nodiscard]] Edge edge_from(std::uint32_t u, std::uint32_t h) const {
    return start(h) == u ? Edge{h, opposite(h)} : Edge{opposite(h), h};
  }
  /// Both sides kNone where u and v are no neighbours.
  [[nodiscard]] Edge find_edge(std::uint32_t u, std::uint32_t v) const;

  /// Moves every face of u to v and removes the faces on the edge between them. Each corner of u takes v's wedge on its side of the curve.
  /// The collapse must be legal (legality.h); O(faces of u).
  void collapse(std::uint32_t u, const Edge& edge);

  /// Checks every invariant: mutual opposites, one fan a vertex, flags and kinds, no repeated corners, counts. Empty where all hold,
  /// else the first violation. O(faces).
  [[nodiscard]] std::string violation() const;

  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  static constexpr std::uint32_t kAlive = 8, kUvShift = 4;
  struct Face {  // half a cache line
    std::array<std::uint32_t, 3> vertex;
    std::uint32_t flags;  // bits 0..2: curve edges; 3: alive; 4, 5: uv sign + 1
    std::array<std::uint32_t, 3> opposite;
    std::uint32_t unused;
  };
  friend class CollapseMeshBuilder;

  void glue(std::uint32_t kept, std::uint32_t other, bool curve);
  void drop_face(std::uint32_t at_edge);

  const Mesh* source_;
  InputRepair repair_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> wedges_;  // by half-edge; empty without uv
  std::vector<std::uint32_t> out_;
  std::vector<VertexKind> kinds_;
  std::vector<std::uint32_t> extra_origin_;  // ascending
  std::uint32_t face_count_ = 0;
  bool moves_ = false;
  std::vector<Vec3f> positions_;  // #V of the source, where moves are allowed; likewise the next two
  std::vector<Vec4f> colors_;
  std::vector<Vec2f> uvs_;  // #W of the source, with uv
};

}  // namespace etalon::simplify
