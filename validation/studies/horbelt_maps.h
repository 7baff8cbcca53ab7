// A terrain's mesh or texture from above, with the viewer and what the view reaches: Figures 2 and 3 of [Horbelt, Balmelli & Vetterli].
#pragma once

#include "core/image/image.h"
#include "core/mesh/mesh.h"
#include "core/terrain/terrain_view.h"

namespace etalon::validation {

/// Edges on paper; north is up. RGB unorm8, square.
[[nodiscard]] Image mesh_from_above(const Mesh& mesh, const terrain::HeightField& field, const terrain::TerrainView& view);
/// The texture (RGB or grey unorm8), nearest texels.
[[nodiscard]] Image texture_from_above(const Image& texture, const terrain::HeightField& field, const terrain::TerrainView& view);

}  // namespace etalon::validation
