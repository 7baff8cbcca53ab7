// The pieces of a parameterization: faces connected over edges across which texture coordinates continue.
#pragma once

#include "core/mesh/mesh.h"

namespace etalon {

struct Chart {
  std::vector<FaceId> faces;  ///< ascending
  int sign = 1;  ///< orientation of most of its area in texture space: 1, or −1 for a mirrored chart, which is legal; 1 without area
  double area_uv = 0;              ///< Σ |area| of its faces in texture space, where the whole texture is 1
  std::vector<FaceId> folds;       ///< faces whose exact orientation is against `sign`, ascending
  std::vector<FaceId> degenerate;  ///< faces of exactly zero area in texture space, ascending
  Vec2f uv_min{0, 0}, uv_max{0, 0};

  /// Area on a texture of that size.
  [[nodiscard]] double area_texels(int width, int height) const { return area_uv * width * height; }
};

struct Charts {
  std::vector<std::uint32_t> of_face;  ///< #F: index into charts
  std::vector<Chart> charts;           ///< numbered by their lowest face
  std::size_t seam_edge_count = 0;     ///< edges of several faces across which texture coordinates do not continue
  std::size_t seam_vertex_count = 0;   ///< vertices on such an edge, the ends of cuts included
  std::size_t split_vertex_count = 0;  ///< vertices that faces use with two or more different texture coordinates
};

/// Charts of a mesh with uv. Faces are connected where they share an edge with equal texture coordinates at both ends, whether or not they
/// share wedge ids. Orientation is of (u, v) as stored, v up; flipping v changes every sign. Signs of faces are exact; the sign of a chart
/// is that of its faces' areas summed in face order in double. Indices out of range or uv not finite fail a check (InternalError):
/// validate_mesh() looks first.
[[nodiscard]] Charts find_charts(const Mesh& mesh);

}  // namespace etalon
