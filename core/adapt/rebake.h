// The rival of adaptation: the texture of a simplified mesh made anew from the full one, by nearest points of the surface.
#pragma once

#include "core/adapt/texel_faces.h"
#include "core/image/image.h"
#include "core/mesh/triangle_tree.h"

namespace etalon::adapt {

struct RebakeOptions {
  int width = 1024, height = 1024;
  int gutter = 2;  ///< texels around the charts, 0..16
};

/// For each texel of `simplified`'s texture (texel_faces): the texture coordinate, on the full mesh, of the full mesh's point nearest to the
/// texel's own point in space. An indexing map, two float32 a texel, which resolve_texture() makes a texture of (nearest lookups of the map); a texel of no face names itself. `tree`: of `full`. The same bytes for
/// any number of threads. InputError where a mesh has no texture coordinates.
[[nodiscard]] Image rebake_map(Renderer& renderer, const Mesh& full, const TriangleTree& tree, const Mesh& simplified,
                               const RebakeOptions& options = {});

}  // namespace etalon::adapt
