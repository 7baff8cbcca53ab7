#include "core/joint/texel_view.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "core/base/error.h"

using namespace etalon;
using namespace etalon::joint;

namespace {

// 17² points, 10 m apart, heights 0..40 m; texture of sample centres.
TerrainExtent small_extent() { return {4, 10, 0.5 / 17, 1.0 / 17, 0, 40}; }

// From south, looking north and down.
terrain::TerrainView oblique_view() {
  return {.eye = {0, 100, 120},
          .target = {0, 20, 20},
          .up = {0, 1, 0},
          .tan_half_fov_y = 0.25,
          .near = 1,
          .far = 1000,
          .width = 64,
          .height = 48};
}

}  // namespace

TEST_CASE("every texel is seen that a point of its vertical line is seen at, and no other") {
  const TerrainExtent extent = small_extent();
  const terrain::TerrainView view = oblique_view();
  const terrain::ViewFrustum frustum(view);
  const int size = 34;
  const wavelet::TexelView texels = texel_view(extent, view, size, size);
  std::size_t seen = 0, agreed = 0;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const double i = ((column + 0.5) / size - extent.uv_start) / extent.uv_step,
                   j = ((row + 0.5) / size - extent.uv_start) / extent.uv_step;
      bool is_seen = false;
      for (int h = 0; h <= 4000 && !is_seen; ++h) is_seen = frustum.contains({(i - 8) * 10, 40 * h / 4000.0, (8 - j) * 10});
      const float pixels = texels.pixels_per_texel[static_cast<std::size_t>(row * size + column)];
      if (is_seen) CHECK(pixels > 0);
      seen += is_seen;
      agreed += is_seen == (pixels > 0);
    }
  CHECK(seen > 50);
  CHECK(seen < 34 * 34 - 50);
  CHECK(agreed + 2 >= 34 * 34);  // a line may graze the frustum between two of the 4001 heights
}

TEST_CASE("a texel's pixels fall with its depth") {
  // Straight down from 200 m upon a flat terrain: 5 m a texel, 48 pixels over 2·200·0.25 = 100 m.
  TerrainExtent extent = small_extent();
  extent.highest_m = 0;
  const terrain::TerrainView down{
      .eye = {0, 200, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .tan_half_fov_y = 0.25, .near = 1, .far = 1000, .width = 64, .height = 48};
  const wavelet::TexelView texels = texel_view(extent, down, 34, 34);
  const float middle = texels.pixels_per_texel[17 * 34 + 17];
  CHECK(middle == doctest::Approx(5 * 48.0 / 100));
  CHECK(texels.covered_pixels[17 * 34 + 17] == middle * middle);
  CHECK(texels.pixels_per_texel[0] == 0);
  extent.highest_m = 100;  // twice as near
  CHECK(texel_view(extent, down, 34, 34).pixels_per_texel[17 * 34 + 17] == doctest::Approx(2 * 5 * 48.0 / 100));
}

TEST_CASE("no terrain, no texture, no view: refused") {
  TerrainExtent none = small_extent();
  none.uv_step = 0;
  CHECK_THROWS_AS((void)texel_view(none, oblique_view(), 4, 4), InputError);
  CHECK_THROWS_AS((void)texel_view(small_extent(), oblique_view(), 0, 4), InputError);
  none = small_extent();
  none.highest_m = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS((void)texel_view(none, oblique_view(), 4, 4), InputError);
  terrain::TerrainView inside_out = oblique_view();
  inside_out.far = 0.5;
  CHECK_THROWS_AS((void)texel_view(small_extent(), inside_out, 4, 4), InputError);
}
