// The gutter: what linear lookups see, in every level, by brute force.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/bake/atlas.h"
#include "core/base/error.h"
#include "core/base/rng.h"

using namespace etalon;
using namespace etalon::bake;

namespace {

constexpr int kFree = -1;

// Who each texel belongs to: as its own, or as a border. All within the map, none to two.
std::vector<int> owners_of(const Atlas& atlas) {
  std::vector<int> owner(static_cast<std::size_t>(atlas.width) * static_cast<std::size_t>(atlas.height), kFree);
  std::uint64_t texels = 0;
  for (std::size_t f = 0; f < atlas.tiles.size(); ++f) {
    const Tile& tile = atlas.tiles[f];
    const auto take = [&](int i, int j) {
      const auto [x, y] = tile.place(i, j);
      REQUIRE((x >= 0 && y >= 0 && x < atlas.width && y < atlas.height));
      int& mine = owner[static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.width) + static_cast<std::size_t>(x)];
      REQUIRE(mine == kFree);
      mine = static_cast<int>(f);
      ++texels;
    };
    for (int j = 0; j < tile.size; ++j)
      for (int i = 0; i + j < tile.size; ++i) take(i, j);
    for_each_border_texel(tile.size, *atlas.gutter, take);
  }
  REQUIRE(texels == atlas.inside_count() + atlas.border_count());
  return owner;
}

// The texels of level 0 under all texels of level `level` that a linear lookup at p (level 0's texels) weighs by more than 0: a texel of
// centre c has weight max(0, 1 − |p − c|) in each direction, lengths in its level's texels. By that definition, over all that are near.
template <class Visit>
void for_each_weighed(const Vec2d& p, int level, const Visit& visit) {
  const double side = std::ldexp(1.0, level);
  const double u = p.x / side, v = p.y / side;  // exact: a power of two
  for (int y = static_cast<int>(std::floor(v)) - 2; y <= std::floor(v) + 2; ++y)
    for (int x = static_cast<int>(std::floor(u)) - 2; x <= std::floor(u) + 2; ++x) {
      if (!(std::abs(u - (x + 0.5)) < 1 && std::abs(v - (y + 0.5)) < 1)) continue;
      for (int t = y << level; t < (y + 1) << level; ++t)
        for (int s = x << level; s < (x + 1) << level; ++s) visit(s, t);
    }
}

// The point of a triangle with these coordinates in its own system, on the paper's corners: exact for dyadic a and b.
Vec2d point_of(const Tile& tile, double a, double b) {
  return tile.turned ? Vec2d{tile.x + tile.size - a, tile.y + tile.size + 1 - b} : Vec2d{tile.x + a, tile.y + b};
}

// Along the three sides in eighths of texels, at the corners exactly, and at random inside.
template <class Visit>
void for_each_point(int size, Rng& rng, const Visit& visit) {
  const int steps = std::min(8 * size, 128);
  for (int n = 0; n <= steps; ++n) {
    const double t = static_cast<double>(size) * n / steps;
    visit(t, 0.0), visit(0.0, t), visit(t, size - t);
  }
  for (int n = 0; n < 16; ++n) {
    const double a = rng.unit() * size;
    visit(a, rng.unit() * (size - a));
  }
}

bool is_whole_level(const Atlas& atlas, int level) { return atlas.width % (1 << level) == 0 && atlas.height % (1 << level) == 0; }

// Lookups at points of triangles that weigh a texel which is not the triangle's.
std::uint64_t foreign_lookups(const Atlas& atlas, int levels, std::uint64_t seed) {
  const std::vector<int> owner = owners_of(atlas);
  Rng rng(seed);
  std::uint64_t foreign = 0;
  for (std::size_t f = 0; f < atlas.tiles.size(); ++f)
    for (int level = 0; level <= levels; ++level) {
      REQUIRE(is_whole_level(atlas, level));
      for_each_point(atlas.tiles[f].size, rng, [&](double a, double b) {
        bool all_own = true;
        for_each_weighed(point_of(atlas.tiles[f], a, b), level, [&](int x, int y) {
          all_own = all_own && x >= 0 && y >= 0 && x < atlas.width && y < atlas.height &&
                    owner[static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.width) + static_cast<std::size_t>(x)] ==
                        static_cast<int>(f);
        });
        foreign += all_own ? 0 : 1;
      });
    }
  return foreign;
}

}  // namespace

TEST_CASE("gutter: no lookup at a point of a triangle, sides and corners too, weighs another's texel in levels 0 to N") {
  Rng rng(11);
  for (int gutter = 0; gutter <= kLargestGutter; ++gutter) {
    CAPTURE(gutter);
    for (int n = 0; n < (gutter < 4 ? 4 : 1); ++n) {
      std::vector<double> ratios(gutter < 5 ? 5 + rng.below(40) : 3 + rng.below(3));
      // Sizes around the border's: below, equal, above.
      for (double& ratio : ratios)
        ratio = rng.unit() * static_cast<double>(std::uint64_t{4} << (rng.below(4) + static_cast<unsigned>(gutter) / 2));
      const int width = std::max(64, 8 << gutter), height = 4 * width;
      const Atlas atlas = make_atlas(ratios, width, height, gutter);
      CHECK(foreign_lookups(atlas, gutter, static_cast<std::uint64_t>(n)) == 0);
    }
  }
}

TEST_CASE("gutter: the level beyond it does reach others, and so does level 0 without one: the test can fail") {
  const std::vector<double> ratios(64, 8);
  for (const int gutter : {0, 1, 2}) {
    const Atlas atlas = make_atlas(ratios, 128, 512, gutter);
    CHECK(foreign_lookups(atlas, gutter, 1) == 0);
    CHECK(foreign_lookups(atlas, gutter + 1, 1) > 0);
  }
}

TEST_CASE("gutter: drawn-in corners as float32, each coordinate off by 5 units of 2^-24, on triangles of every size") {
  Rng rng(12);
  for (const int gutter : {0, 1, 3}) {
    std::vector<double> ratios(60);
    for (double& ratio : ratios) ratio = static_cast<double>(2u << rng.below(6));
    const Atlas atlas = make_atlas(ratios, 512, 1024, gutter);
    const std::vector<int> owner = owners_of(atlas);
    const double share = drawn_in_share(atlas);
    for (std::size_t f = 0; f < atlas.tiles.size(); ++f) {
      Vec2d uv[3];
      for (int c = 0; c < 3; ++c) {
        const Vec2d p = corner_place(atlas.tiles[f], c, share);
        uv[c] = {static_cast<float>(p.x / atlas.width), static_cast<float>(p.y / atlas.height)};
      }
      for (int side = 0; side < 3; ++side)
        for (int n = 0; n <= 64; ++n)
          for (const double ex : {-5 * 0x1p-24, 5 * 0x1p-24})
            for (const double ey : {-5 * 0x1p-24, 5 * 0x1p-24}) {
              const Vec2d &a = uv[side], &b = uv[(side + 1) % 3];
              const double t = n / 64.0;
              const Vec2d p{(a.x + t * (b.x - a.x) + ex) * atlas.width, (a.y + t * (b.y - a.y) + ey) * atlas.height};
              for (int level = 0; level <= gutter; ++level)
                for_each_weighed(p, level, [&](int x, int y) {
                  REQUIRE(owner[static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.width) + static_cast<std::size_t>(x)] ==
                          static_cast<int>(f));
                });
            }
    }
  }
}

TEST_CASE("gutter: the tiling places what it was asked to, within its height, in blocks on multiples of the border") {
  Rng rng(13);
  for (int n = 0; n < 300; ++n) {
    const int gutter = static_cast<int>(rng.below(5));
    SizeCounts counts{};
    int largest = 0;
    for (int k = 1; k <= 8; ++k)
      if ((1 << k) >= least_size(gutter) && rng.coin()) counts[static_cast<std::size_t>(k)] = rng.below(40), largest = 1 << k;
    if (largest == 0) continue;
    const int width = 1024;
    const PairTiling tiling = tile_pairs(counts, width, gutter);
    SizeCounts placed{};
    for (const PairRun& run : tiling.runs) {
      const PairBlock block = pair_block(run.size, gutter);
      for (int k = 1; k < kSizeCount; ++k)
        if (run.size == 1 << k) placed[static_cast<std::size_t>(k)] += run.count;
      REQUIRE(run.x % (1 << gutter) == 0);
      REQUIRE(run.top % (std::uint64_t{1} << gutter) == 0);
      REQUIRE(static_cast<std::uint64_t>(run.x) + std::min(run.columns, run.count) * static_cast<std::uint64_t>(block.width) <= width);
      REQUIRE(run.top + (run.count + run.columns - 1) / run.columns * static_cast<std::uint64_t>(block.height) <= tiling.height);
    }
    for (std::size_t k = 0; k < kSizeCount; ++k) REQUIRE(placed[k] == (counts[k] + 1) / 2);
    // The counts of a border are those of its loop.
    for (int size = least_size(gutter); size <= 64; size *= 2) {
      std::uint64_t texels = 0;
      for_each_border_texel(size, gutter, [&](int, int) { ++texels; });
      REQUIRE(texels == border_texels(size, gutter));
    }
  }
}

TEST_CASE("gutter: without one, nothing is changed; with one, only room is") {
  const std::vector<double> ratios(100, 6);
  const Atlas without = make_atlas(ratios, 128, 128), with = make_atlas(ratios, 1024, 1024, 0);
  CHECK_FALSE(without.gutter);
  CHECK(without.border_count() == 0);
  CHECK(without.rows == without.rows_without);
  CHECK(with.rows > with.rows_without);
  for (std::size_t f = 0; f < ratios.size(); ++f) CHECK(with.tiles[f].size == without.tiles[f].size);
}

TEST_CASE("gutter: a map too small is refused with the size that would do, and that size does") {
  const std::vector<double> ratios(300, 9);
  CHECK_THROWS_WITH_AS((void)make_atlas(ratios, 64, 64, 0),
                       "300 triangles do not fit in a texture map of 64x64 with a gutter for 0 mip levels: the smallest of this width is "
                       "64x70, the smallest square 128x128",
                       InputError);
  CHECK(make_atlas(ratios, 64, 70, 0).tiles.size() == 300);
  CHECK_THROWS_AS((void)make_atlas(ratios, 64, 69, 0), InputError);
  CHECK_THROWS_WITH_AS((void)make_atlas(ratios, 16, 16, 2),
                       "300 triangles do not fit in a texture map of 16x16 with a gutter for 2 mip levels: the smallest of this width is "
                       "16x1200, the smallest square 256x256",
                       InputError);
  CHECK(make_atlas(ratios, 16, 1200, 2).tiles.size() == 300);
  CHECK_THROWS_AS((void)make_atlas(ratios, 16, 1196, 2), InputError);
  CHECK(make_atlas(ratios, 256, 256, 2).tiles.size() == 300);
  CHECK_THROWS_WITH_AS((void)make_atlas(ratios, 4, 32, 1), "a texture map of 4x32 with a gutter for 1 mip levels: expected at least 8x12",
                       InputError);
  CHECK_THROWS_WITH_AS((void)make_atlas(ratios, 64, 66, 2),
                       "a texture map of 64x66 with a gutter for 2 mip levels: expected a height that is a multiple of 4", InputError);
  CHECK_THROWS_WITH_AS((void)make_atlas(ratios, 64, 64, 9), "expected a gutter for 0 to 8 mip levels, got 9", InputError);
  CHECK_THROWS_AS((void)make_atlas(ratios, 64, 64, -1), InputError);
  CHECK_THROWS_WITH_AS((void)make_atlas(std::vector<double>(200000, 1), 16384, 16384, 8),
                       "200000 triangles do not fit in a texture map of 16384x16384 with a gutter for 8 mip levels: nor in the largest, "
                       "16384x16384: expected fewer triangles",
                       InputError);
}
