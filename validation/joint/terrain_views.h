// Views of a terrain by its own size: the five that `study horbelt` looks from.
#pragma once

#include <string>
#include <vector>

#include "core/draw/renderer.h"
#include "core/terrain/terrain_view.h"

namespace etalon::validation {

struct NamedTerrainView {
  std::string name;   ///< [a-z0-9_-]
  std::string title;  ///< "from above"
  terrain::TerrainView view;
};

/// `overview` from south, the whole terrain in the frame.
[[nodiscard]] NamedTerrainView terrain_overview(const terrain::HeightField& field, int width, int height);

/// `valley`, as the paper's Figure 1 only a tenth of the terrain: the eye is as high as makes 10 % of the full mesh's triangles reach a pixel,
/// found by bisection on the renderer's ids; then overview, `above`, `ridge` and `slope`. A camera's height is above the ground below it.
[[nodiscard]] std::vector<NamedTerrainView> terrain_views(Renderer& renderer, const terrain::HeightField& field, int width, int height);

}  // namespace etalon::validation
