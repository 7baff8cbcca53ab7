// Drawings of the study, made of what core/adapt computes: figures 1 and 4 to 7 of the paper.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/adapt/adapt_sequence.h"
#include "core/progressive/progressive_mesh.h"
#include "validation/studies/chen_examples.h"

namespace etalon::validation {

/// One collapse of a mesh with its cells, to be drawn.
struct ChenCollapse {
  std::size_t split = 0;
  adapt::RingCells cells;
  std::size_t ring = 0;          ///< corners; nodes 1 to `ring`
  std::vector<Vec3d> positions;  ///< of u, then of the ring
  double score = 0;              ///< how well it can be drawn
};

/// The collapse that shows most: inside a chart, a ring of 6 to 8 corners, 2 to 5 crossings, nothing damped; of those the one whose cells are
/// roundest and most alike while u and the crossings move; ties: the first. Nothing where no collapse is like that.
[[nodiscard]] std::optional<ChenCollapse> showing_collapse(progressive::ProgressiveMesh& mesh, const adapt::AdaptSequence& sequence);

/// SVG elements, no outside resources.
[[nodiscard]] std::string line_drawing(const ChenLineExample& line);
[[nodiscard]] std::string neighbourhood_drawing(const ChenCollapse& collapse);   ///< Figure 4
[[nodiscard]] std::string overlay_drawing(const ChenCollapse& collapse);         ///< Figure 5
[[nodiscard]] std::string correspondence_drawing(const ChenCollapse& collapse);  ///< Figure 6
[[nodiscard]] std::string fan_drawing(const ChenCollapse& collapse);             ///< Figure 7

/// Figure 9 with numbers: a row of texels drawn together to half as many, by adapting texels against adapting coordinates.
[[nodiscard]] std::string blur_drawing();

}  // namespace etalon::validation
