// What is wrong with a mesh, and where.
#pragma once

#include <optional>
#include <string>

#include "core/mesh/charts.h"
#include "core/mesh/mesh.h"

namespace etalon {

/// One kind of finding: how often, and the lowest few indices of what it was found at.
struct Defect {
  std::size_t count = 0;
  std::vector<std::uint32_t> first;
  [[nodiscard]] bool found() const { return count > 0; }
};

struct MeshValidationOptions {
  int texture_width = 1024;  ///< size at which charts are called tiny
  int texture_height = 1024;
  int overlap_grid = 2048;     ///< cells on a side for uv_overlap
  std::size_t list_limit = 5;  ///< places named per defect
};

/// Numbers of a mesh. Everything after `indices_in_range` is 0 or empty where that is false; everything about uv where the mesh has none
/// or it is not finite.
struct MeshReport {
  std::size_t vertex_count = 0, wedge_count = 0, face_count = 0;
  bool indices_in_range = true;
  bool has_uv = false;

  // Values.
  Defect wedges_out_of_range;    ///< faces that name a wedge, or wedge's vertex, that is not there
  Defect non_finite_vertices;    ///< vertices with a position or colour that is infinite or not a number
  Defect non_finite_wedges;      ///< wedges with such a uv
  Defect unreferenced_vertices;  ///< vertices of no face

  // Topology over vertices; two vertices at one place are two (see welded_by_position).
  std::size_t edge_count = 0, component_count = 0, boundary_loop_count = 0;
  std::int64_t euler_characteristic = 0;  ///< referenced vertices − edges + faces
  std::optional<std::int64_t> genus;      ///< of a closed, manifold, consistently oriented mesh, summed over its components
  Defect boundary_edges;                  ///< faces at an edge of one face
  Defect non_manifold_edges;              ///< lowest faces at an edge of three or more faces
  Defect non_manifold_vertices;           ///< vertices whose faces do not form one fan
  Defect inconsistent_edges;              ///< lowest faces at an edge that both its faces run along in the same direction
  Defect duplicate_faces;                 ///< faces with the same three vertices as an earlier one
  Defect degenerate_faces;                ///< faces of exactly zero area in space

  // Texture space.
  std::size_t chart_count = 0, largest_chart_faces = 0;
  std::size_t seam_edge_count = 0, seam_vertex_count = 0, split_vertex_count = 0;  ///< as in Charts
  std::size_t negative_uv_faces = 0;                                               ///< faces of exactly negative area in (u, v), v up
  Vec2f uv_min{0, 0}, uv_max{0, 0};
  Defect degenerate_uv_faces;            ///< faces of exactly zero area in texture space
  Defect folds;                          ///< faces oriented against their chart
  Defect mirrored_charts;                ///< charts of negative orientation: legal
  std::size_t mirrored_chart_faces = 0;  ///< negative faces in mirrored charts
  Defect tiny_charts;                    ///< charts of less than one texel of area
  Defect uv_outside;                     ///< wedges used by faces, outside [0, 1]²
  Defect uv_overlaps;                    ///< faces that share a cell of the overlap grid with another one
  double uv_overlap_share = 0;           ///< of the covered cells, those covered twice or more
  double uv_coverage = 0;                ///< of all cells, those covered
  int overlap_grid = 0;

  [[nodiscard]] bool manifold() const { return indices_in_range && !non_manifold_edges.found() && !non_manifold_vertices.found(); }
  [[nodiscard]] bool closed() const { return indices_in_range && face_count > 0 && !boundary_edges.found(); }
  [[nodiscard]] bool oriented() const { return indices_in_range && !inconsistent_edges.found(); }

  /// For a person: what the mesh is, then one line per kind of finding with its count and first places.
  [[nodiscard]] std::vector<std::string> to_lines() const;
};

/// Examines a mesh; never throws on a broken one. Signs of areas and zero areas are exact; overlaps are counted on a grid (uv_overlap.h).
[[nodiscard]] MeshReport validate_mesh(const Mesh& mesh, const MeshValidationOptions& options = {});

}  // namespace etalon
