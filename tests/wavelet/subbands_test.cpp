#include "core/wavelet/subbands.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/wavelet/lifting.h"

using namespace etalon::wavelet;

TEST_CASE("subbands: they tile the plane, whatever its size") {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 7}, {5, 3}, {64, 64}, {100, 37}}) {
    for (const int levels : {1, 2, 5}) {
      std::vector<int> covered(static_cast<std::size_t>(width * height));
      for (const Subband& band : make_subbands(width, height, levels, Kernel::reversible_5_3))
        for (int y = 0; y < band.height; ++y)
          for (int x = 0; x < band.width; ++x) ++covered[static_cast<std::size_t>((band.y0 + y) * width + band.x0 + x)];
      CHECK(covered == std::vector<int>(covered.size(), 1));
    }
  }
}

TEST_CASE("subbands: the norms are those of the pictures of unit coefficients") {
  // By the two-dimensional inverse itself, in the middle of a picture large enough.
  for (const Subband& band : make_subbands(256, 256, 3, Kernel::irreversible_9_7)) {
    Plane<double> plane(256, 256);
    plane.row(band.y0 + band.height / 2)[band.x0 + band.width / 2] = 1;
    inverse(plane, 3);
    double sum = 0;
    for (const double v : plane.values) sum += v * v;
    CHECK(std::abs(std::sqrt(sum) - band.norm) < 1e-12 * band.norm);
  }
  // 5/3 by hand: low ½ 1 ½, high −⅛ −¼ ¾ −¼ −⅛ (squares 3/2 and 23/32).
  const std::vector<Subband> bands = make_subbands(64, 64, 1, Kernel::reversible_5_3);
  CHECK(bands[0].norm == doctest::Approx(1.5).epsilon(1e-15));
  CHECK(bands[1].norm == doctest::Approx(std::sqrt(1.5 * 23 / 32)).epsilon(1e-15));
  CHECK(bands[3].norm == doctest::Approx(23.0 / 32).epsilon(1e-15));
}

TEST_CASE("subbands: default levels leave eight coefficients, and at least one level") {
  CHECK(default_levels(1, 1) == 1);
  CHECK(default_levels(512, 512) == 6);
  CHECK(default_levels(512, 20) == 1);
  CHECK(default_levels(32768, 32768) == kMaxLevels);
}
