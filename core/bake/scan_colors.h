// A texture from the scan's whole surface instead of its vertices. Ours, not the paper's.
#pragma once

#include "core/bake/texel_colors.h"
#include "core/mesh/triangle_tree.h"

namespace etalon::bake {

struct ScanColors {
  std::vector<Rgb8> color;  ///< #T
  double distance_max = 0;  ///< of a texel's centre to the nearest point of the scan, in space, model units
};

/// Every texel's colour: the mean of the scan's colours at the points of the scan nearest in space to five places: its centre and, a third of
/// a texel from it along both legs, four around it, those on the triangle's own side of the hypotenuse. Five of equal weight that far apart
/// have nearly the spread of the whole texel (4/45 against 1/12 of a side squared). The four lie farther out by two thirds of the distance h of
/// the centre to the scan, along each of two right-angled directions in the triangle's plane: which point of the scan shows there depends on
/// the view, and moves by h where the view leans by 45° (docs/papers/bake.md).
///
/// A colour on the scan is linear in its triangle, of colours clamped to [0, 1], each channel on its own, rounded to the nearest byte,
/// halves up; means are taken in integers, and so rounded. Of equally near points the scan's lowest face. Texels that continuity equates
/// have one colour, the mean of all their places. The same for every thread count. `tree`: of the scan.
[[nodiscard]] ScanColors sample_scan(const Mesh& scan, const TriangleTree& tree, const Mesh& mesh, const Atlas& atlas,
                                     const TexelNodes& nodes);

}  // namespace etalon::bake
