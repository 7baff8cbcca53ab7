// What a view does with a terrain's texture, from what a file's header holds: grid, range of heights, view. No height of a point is read, so a decoder
// knows it before the first segment.
#pragma once

#include "core/terrain/terrain_view.h"
#include "core/wavelet/delays.h"

namespace etalon::joint {

/// Where a texture's texels lie: column c of `texture_width` is at grid coordinate ((c + ½)/texture_width − uv_start)/uv_step, and so are rows.
struct TerrainExtent {
  int bits = 0;                        ///< k of the (2^k + 1)² grid
  double spacing = 1;                  ///< metres between grid points
  double uv_start = 0, uv_step = 0;    ///< texture coordinate of grid point 0, and from one to the next
  double lowest_m = 0, highest_m = 0;  ///< every height is between
};

/// A texel is seen if the vertical line through its centre, from the lowest to the highest height, meets the frustum; pixels_per_texel is then the
/// length on the screen of a texel's side across the view at that line's nearest seen depth, covered_pixels its square (slopes are not known).
/// Texels beside the terrain are not seen. So nothing that any level of the terrain can show is left out, but for texels whose centre is outside by
/// less than a texel; core/wavelet's neighbourhoods hold those. InputError: ViewFrustum's, and an extent that is none.
[[nodiscard]] wavelet::TexelView texel_view(const TerrainExtent& extent, const terrain::TerrainView& view, int texture_width,
                                            int texture_height);

}  // namespace etalon::joint
