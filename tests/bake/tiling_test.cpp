// How rectangles fill a map.
#include <doctest/doctest.h>

#include <algorithm>

#include "core/bake/tiling.h"
#include "core/base/rng.h"

using namespace etalon;
using namespace etalon::bake;

TEST_CASE("a half-square triangle of size 4 has ten texels, as in figure 3") {
  CHECK(texels_of_size(2) == 3);
  CHECK(texels_of_size(4) == 10);
}

TEST_CASE("rectangles go to the highest free place, leftmost first") {
  // Width 8: 4 × 5 twice in the first row, 2 × 3 four times in the second, then under the first two again.
  const std::vector<Place> places = tile_rectangles({4, 4, 2, 2, 2, 2, 2}, 8);
  const std::vector<Place> expected{{0, 0}, {4, 0}, {0, 5}, {2, 5}, {4, 5}, {6, 5}, {0, 8}};
  CHECK(places == expected);
}

TEST_CASE("a smaller rectangle fills the step beside a larger one before it goes below") {
  const std::vector<Place> places = tile_rectangles({8, 4, 2, 2, 2}, 16);
  // 8 × 9 at the left, 4 × 5 beside it, 2 × 3 beside that; the next below the 2 × 3 would be row 3: above rows 5 and 9.
  const std::vector<Place> expected{{0, 0}, {8, 0}, {12, 0}, {14, 0}, {12, 3}};
  CHECK(places == expected);
}

TEST_CASE("area alone lies: three pairs of 256 x 257 use 75 % of 512 x 512 and need 514 rows") {
  SizeCounts counts{};
  counts[8] = 6;
  CHECK(tiling_height(counts, 512) == 514);
  CHECK(6 * texels_of_size(256) < 512 * 512);
}

TEST_CASE("odd classes hand one triangle down, through empty classes too; the lowest stays odd") {
  SizeCounts counts{};
  counts[5] = 3;
  counts[2] = 4;
  SizeCounts even{};
  even[5] = 2;
  even[2] = 5;
  CHECK(even_counts(counts) == even);
  SizeCounts single{};
  single[6] = 1;
  CHECK(even_counts(single) == single);
}

TEST_CASE("the height from the counts is that of the tiling itself") {
  Rng rng(1);
  for (int n = 0; n < 2000; ++n) {
    const int log_width = static_cast<int>(rng.between(1, 8));
    SizeCounts counts{};
    for (int k = 1; k <= log_width; ++k)
      if (rng.coin()) counts[static_cast<std::size_t>(k)] = rng.below(12u << (log_width - k) / 2);
    counts = even_counts(counts);
    std::vector<int> widths;
    for (int k = log_width; k > 0; --k) widths.insert(widths.end(), (counts[static_cast<std::size_t>(k)] + 1) / 2, 1 << k);
    std::uint64_t height = 0;
    const std::vector<Place> places = tile_rectangles(widths, 1 << log_width);
    for (std::size_t i = 0; i < widths.size(); ++i) height = std::max(height, places[i].top + static_cast<std::uint64_t>(widths[i]) + 1);
    REQUIRE(tiling_height(counts, 1 << log_width) == height);
  }
}

TEST_CASE("the smallest map: rows of W / 2 pairs, three texels each") {
  CHECK(least_height(1, 2) == 3);
  CHECK(least_height(3, 2) == 6);
  CHECK(least_height(1000, 512) == 6);
  CHECK(least_square(1) == 4);
  CHECK(least_square(1000) == 64);  // 32 pairs a row, 16 rows of 3: 48; of 32 it would be 32 rows: 96
  for (const std::uint64_t n : {1u, 2u, 7u, 100u, 999u}) {
    SizeCounts counts{};
    counts[1] = n;
    CHECK(tiling_height(counts, 32) == least_height(n, 32));
  }
}
