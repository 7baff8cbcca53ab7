// The cells of one vertex split of a progressive mesh, chart by chart.
#pragma once

#include <vector>

#include "core/adapt/edge_cells.h"
#include "core/adapt/ring_cells.h"
#include "core/adapt/vertex_faces.h"
#include "core/progressive/progressive_mesh.h"

namespace etalon::adapt {

/// Why a split has no cells on one side of its curve.
enum class CellStatus : std::uint8_t {
  made,
  fold,      ///< a triangle of the ring is turned against the others in the texture plane, or has no area there
  no_place,  ///< make_ring_cells() or make_edge_cells() found no positive cells
  gone,      ///< on a curve: no triangle is left after the collapse
  no_fan,    ///< the triangles on that side are no fan that begins or ends at v: a file may hold such a mesh
};
inline constexpr std::size_t kCellStatusCount = 5;
/// "made", "fold", …: as documents name them.
[[nodiscard]] const char* to_string(CellStatus status);

/// The cells on one side of u's curve, or all around u: in texture coordinates as they are, so those of a mirrored chart are clockwise.
struct ChartCells {
  CellStatus status = CellStatus::made;
  RingCells cells;  ///< empty unless made
  friend bool operator==(const ChartCells&, const ChartCells&) = default;
};

/// What has been chosen for the cells of one ring.
struct CellChoice {
  OverlayPlane plane = OverlayPlane::texture_after;
  double place_share = 1, crossing_share = 1;
  Vec2f place{0, 0};  ///< of u after a half-edge collapse, in the texture of the mesh
};

/// The ring that ChartCells are made of.
struct ChartRing {
  CellStatus status = CellStatus::made;  ///< `made`: it is unfolded; or fold, or gone
  CollapseRing ring;
  std::optional<EdgeRing> edge;  ///< instead, of a full-edge collapse in the inside of a chart
  bool reflected = false;        ///< `ring` has (u, −v) for the texture coordinate (u, v)
};

/// One for an interior vertex, one or two for a vertex on a curve. A full-edge collapse on a curve is one of each end into the merged vertex,
/// which lies on the edge between them: up to four. `mesh` has to be at level split + 1 (ETALON_CHECK); it must have texture coordinates.
/// `faces`: of the mesh there; without, a full-edge collapse looks at every face.
[[nodiscard]] std::vector<ChartCells> cells_of_split(const progressive::ProgressiveMesh& mesh, std::size_t split,
                                                     const VertexFaces* faces = nullptr);

/// The rings that cells_of_split() makes its cells of, in the same order; the same demands.
[[nodiscard]] std::vector<ChartRing> rings_of_split(const progressive::ProgressiveMesh& mesh, std::size_t split,
                                                    const VertexFaces* faces = nullptr);
/// The cells of one of them.
[[nodiscard]] ChartCells make_chart_cells(const ChartRing& ring);
/// What make_chart_cells() gives where the choice is known: ring_cells_at(), edge_cells_at(). Status no_place where it leaves no cells, is
/// not of this kind of ring, or the ring has none.
[[nodiscard]] ChartCells chart_cells_at(const ChartRing& ring, const CellChoice& choice);

}  // namespace etalon::adapt
