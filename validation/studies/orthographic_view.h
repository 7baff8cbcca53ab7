// A range image's surface seen as its sensor saw it: along −z, one texel a sample [Soucy, Godin & Rioux 1996, sec. 5].
#pragma once

#include <memory>

#include "core/mesh/mesh.h"
#include "validation/studies/checked_drawing.h"

namespace etalon::validation {

/// Which samples a frame shows: sample (i, j) of a range image is at ((i + ½)·spacing, (j + ½)·spacing) and on the centre of texel
/// (i + 1, j + 1), so that one texel is left around all of them.
struct SampleGrid {
  int width = 0, height = 0;  ///< samples
  double spacing = 1;         ///< model units
};

/// The draw list of `mesh`: its vertex colours, or `texture` looked up at the nearest texel. Higher z is nearer. RGBA unorm8 on black, and
/// ids, of (width + 2) × (height + 2) texels. InputError where the mesh is farther outside the grid than a frame's guard, or a position is not finite.
[[nodiscard]] StudyScene orthographic_scene(const Mesh& mesh, const std::shared_ptr<const Image>& texture, const SampleGrid& grid,
                                            const RasterState& state);

}  // namespace etalon::validation
