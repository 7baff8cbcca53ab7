// A texture from the scan's whole surface instead of its vertices. Ours, not the paper's.
#pragma once

#include "core/bake/texel_colors.h"

namespace etalon::bake {

struct ScanColors {
  std::vector<Rgb8> color;  ///< #T
  double distance_max = 0;  ///< of a texel's centre to the nearest point of the scan, in space, model units
};

/// Every texel's colour: the mean of the scan's colours at the points of the scan nearest in space to `places_a_side`² places for each texel
/// (a side: 1 to 16), spread evenly over the texel, those on its own side of the hypotenuse; and farther apart by the distance h of the
/// texel's centre to the scan, by less than h from the centre along each of two right-angled directions in the triangle's plane: which point
/// of the scan shows there depends on the view, and moves by h where the view leans by 45° (docs/papers/bake.md). One place: the centre.
///
/// A colour on the scan is linear in its triangle, of colours clamped to [0, 1], each channel on its own, rounded to the nearest byte,
/// halves up; means are taken in integers, and so rounded. Of equally near points the scan's lowest face. Texels that continuity equates
/// have one colour, the mean of all their places. The same for every thread count.
[[nodiscard]] ScanColors sample_scan(const Mesh& scan, const Mesh& mesh, const Atlas& atlas, const TexelNodes& nodes,
                                     int places_a_side = 3);

}  // namespace etalon::bake
