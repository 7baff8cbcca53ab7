// A subject's levels with everything that can be hung on them: adapted textures, indexing maps, the exact chain, re-baked textures.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/adapt/adapt_sequence.h"
#include "core/adapt/chart_borders.h"
#include "core/draw/renderer.h"
#include "core/progressive/progressive_mesh.h"

namespace etalon::validation {

struct ChenLevel {
  std::size_t level = 0;                                       ///< of the progressive mesh
  Mesh mesh;                                                   ///< by 5-D quadrics
  Mesh by_deviation;                                           ///< by texture deviation (APS), as many faces
  std::shared_ptr<const Image> map, analytic;                  ///< RG float32
  std::vector<std::shared_ptr<const Image>> adapted, rebaked;  ///< one a texture
};

struct ChenLevels {
  progressive::ProgressiveMesh mesh;
  adapt::AdaptSequence sequence;
  adapt::ChartBorders borders;
  std::vector<ChenLevel> levels;
};

/// `levels`: faces, descending; a level that cannot be reached is the least there is. `step` is called with a label before each part.
[[nodiscard]] ChenLevels make_chen_levels(Renderer& renderer, const Mesh& mesh, const std::vector<const Image*>& textures,
                                          const std::vector<std::size_t>& levels, int map_size,
                                          const std::function<void(const std::string&)>& step);

}  // namespace etalon::validation
