#include "core/bake/gutter.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/bake/atlas.h"
#include "core/base/error.h"

namespace etalon::bake {
namespace {

// What is free beside and under placed pairs.
struct Free {
  std::uint64_t x = 0, top = 0, width = 0, height = 0;
};

class PairTiler {
 public:
  PairTiler(int width, int gutter) : width_(static_cast<std::uint64_t>(width)), gutter_(gutter) {}

  void place(int size, std::uint64_t pairs) {
    const PairBlock block = pair_block(size, gutter_);
    const auto w = static_cast<std::uint64_t>(block.width), h = static_cast<std::uint64_t>(block.height);
    ETALON_CHECK(w <= width_, fmt::format("a rectangle of {} columns in a map of {}", w, width_));
    std::vector<Free> kept;
    for (const Free& free : free_) pairs -= fill(free, size, w, h, pairs, kept);
    if (pairs > 0) {
      const std::uint64_t columns = width_ / w, rows = (pairs + columns - 1) / columns;
      (void)fill({0, tiling_.height, width_, rows * h}, size, w, h, pairs, kept);
      tiling_.height += rows * h;
    }
    free_ = std::move(kept);
  }

  PairTiling done() && { return std::move(tiling_); }

 private:
  std::uint64_t fill(const Free& free, int size, std::uint64_t w, std::uint64_t h, std::uint64_t pairs, std::vector<Free>& kept) {
    const std::uint64_t columns = free.width / w, placed = std::min(pairs, columns * (free.height / h));
    if (placed == 0) {
      kept.push_back(free);
      return 0;
    }
    const std::uint64_t rows = (placed + columns - 1) / columns, in_last = placed - (rows - 1) * columns;
    tiling_.runs.push_back({size, static_cast<int>(free.x), free.top, columns, placed});
    const auto keep = [&](const Free& rest) {
      if (rest.width > 0 && rest.height > 0) kept.push_back(rest);
    };
    keep({free.x + in_last * w, free.top + (rows - 1) * h, (columns - in_last) * w, h});
    keep({free.x + columns * w, free.top, free.width - columns * w, rows * h});
    keep({free.x, free.top + rows * h, free.width, free.height - rows * h});
    return placed;
  }

  std::uint64_t width_;
  int gutter_;
  PairTiling tiling_;
  std::vector<Free> free_;
};

using Color = std::array<int, 3>;

Color color_at(const Image& image, const TexelPlace& place) {
  const std::uint8_t* const c = image.channels<std::uint8_t>(place.x, place.y);
  return {c[0], c[1], c[2]};
}

// The nearest texel of the triangle; of two beyond the hypotenuse the one of larger j.
std::array<int, 2> nearest_own(int size, int i, int j) {
  i = std::max(i, 0), j = std::max(j, 0);
  const int beyond = i + j - (size - 1);
  if (beyond <= 0) return {i, j};
  i -= (beyond + 1) / 2, j -= beyond / 2;
  if (i < 0) return {0, size - 1};
  if (j < 0) return {size - 1, 0};
  return {i, j};
}

Color border_color(const Image& image, const Tile& tile, int i, int j) {
  if (i > 0 && j > 0 && i + j == tile.size) {
    const Color a = color_at(image, tile.place(i - 1, j)), b = color_at(image, tile.place(i, j - 1)),
                c = color_at(image, tile.place(i - 1, j - 1));
    Color sum{};
    for (std::size_t k = 0; k < 3; ++k) sum[k] = std::clamp(a[k] + b[k] - c[k], 0, 255);
    return sum;
  }
  const auto [near_i, near_j] = nearest_own(tile.size, i, j);
  return color_at(image, tile.place(near_i, near_j));
}

}  // namespace

PairBlock pair_block(int size, int gutter) {
  const int border = 1 << gutter;
  if (2 * size <= border) return {2 * border, 4 * border};
  const int side = std::max(size, border);
  return {side + 2 * border, side + 5 * border};
}

PairTiling tile_pairs(const SizeCounts& counts, int width, int gutter) {
  PairTiler tiler(width, gutter);
  for (int k = kSizeCount - 1; k > 0; --k) {
    const std::uint64_t pairs = (counts[static_cast<std::size_t>(k)] + 1) / 2;
    if (pairs > 0) tiler.place(1 << k, pairs);
  }
  return std::move(tiler).done();
}

std::uint64_t least_height(std::uint64_t triangles, int width, Gutter gutter) {
  if (!gutter) return least_height(triangles, width);
  const PairBlock block = pair_block(least_size(gutter), *gutter);
  const std::uint64_t pairs = (triangles + 1) / 2, columns = static_cast<std::uint64_t>(width / block.width);
  if (columns == 0) return ~std::uint64_t{0};
  return (pairs + columns - 1) / columns * static_cast<std::uint64_t>(block.height);
}

std::uint64_t least_square(std::uint64_t triangles, Gutter gutter) {
  std::uint64_t side = 4;
  while (least_height(triangles, static_cast<int>(side), gutter) > side) side *= 2;
  return side;
}

std::uint64_t border_texels(int size, int gutter) {
  const auto d = static_cast<std::uint64_t>(size), border = std::uint64_t{1} << gutter;
  if (2 * d <= border) return 4 * border * border - texels_of_size(d);
  const std::uint64_t n = std::max<std::uint64_t>(d / border, 1);
  // Of the (n + 2)² cells those with I + J > n are missing.
  return ((n + 2) * (n + 2) - n * (n + 1) / 2) * border * border - texels_of_size(d);
}

void paint_borders(const Atlas& atlas, Image& image) {
  ETALON_CHECK(image.format() == kRgb8, to_string(image.format()));
  if (!atlas.gutter) return;
  for (const Tile& tile : atlas.tiles)
    for_each_border_texel(tile.size, *atlas.gutter, [&](int i, int j) {
      const Color color = border_color(image, tile, i, j);
      const auto [x, y] = tile.place(i, j);
      for (std::size_t k = 0; k < 3; ++k) image.channels<std::uint8_t>(x, y)[k] = static_cast<std::uint8_t>(color[k]);
    });
}

}  // namespace etalon::bake
