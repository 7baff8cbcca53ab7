#include "core/bake/atlas.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "core/math/nearest_point.h"

namespace etalon::bake {
namespace {

// The lower left texel of a rectangle.
struct Corner {
  int x = 0, y = 0;
};

// A rectangle for each of the widths, which descend.
std::vector<Corner> pair_corners(Atlas& atlas, const std::vector<int>& widths) {
  std::vector<Corner> corners;
  corners.reserve(widths.size());
  const auto add = [&](int x, std::uint64_t top, int height) {
    corners.push_back({x, atlas.height - static_cast<int>(top) - height});
    atlas.rows = std::max(atlas.rows, top + static_cast<std::uint64_t>(height));
  };
  SizeCounts counts{};
  for (const int width : widths) counts[static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(width))) % kSizeCount] += 2;
  atlas.rows_without = tiling_height(counts, atlas.width);
  if (!atlas.gutter) {
    const std::vector<Place> places = tile_rectangles(widths, atlas.width);
    for (std::size_t n = 0; n < widths.size(); ++n) add(places[n].x, places[n].top, widths[n] + 1);
    return corners;
  }
  for (const PairRun& run : tile_pairs(counts, atlas.width, *atlas.gutter).runs) {
    const PairBlock block = pair_block(run.size, *atlas.gutter);
    for (std::uint64_t n = 0; n < run.count; ++n)
      add(run.x + static_cast<int>(n % run.columns) * block.width, run.top + n / run.columns * static_cast<std::uint64_t>(block.height),
          block.height);
  }
  return corners;
}

// Largest first, then by face; two of one size to a rectangle. Of a pair the first is the upper half, so that a last one alone leaves the
// lower half free.
void place_tiles(Atlas& atlas) {
  std::vector<std::uint32_t> order(atlas.tiles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return atlas.tiles[a].size > atlas.tiles[b].size; });
  std::vector<int> widths;
  std::vector<std::size_t> rectangle(order.size());
  bool half_used = false;
  for (std::size_t n = 0; n < order.size(); ++n) {
    Tile& tile = atlas.tiles[order[n]];
    const bool second = half_used && widths.back() == tile.size;
    if (!second) widths.push_back(tile.size);
    half_used = !second;
    tile.turned = !second;
    rectangle[n] = widths.size() - 1;
  }
  const std::vector<Corner> corners = pair_corners(atlas, widths);
  for (std::size_t n = 0; n < order.size(); ++n) {
    Tile& tile = atlas.tiles[order[n]];
    tile.x = corners[rectangle[n]].x;
    tile.y = corners[rectangle[n]].y;
    if (!atlas.gutter) continue;
    const int border = 1 << *atlas.gutter;
    const PairBlock block = pair_block(tile.size, *atlas.gutter);
    tile.x += tile.turned ? block.width - border - tile.size : border;
    tile.y += tile.turned ? block.height - border - tile.size - 1 : border;
  }
}

// The corner opposite to the longest side.
int corner_of_right_angle(const Mesh& mesh, FaceId f) {
  int best = 2;
  double longest = -1;
  for (int c = 0; c < 3; ++c) {
    const Vec3d d = difference_of(mesh.position(f, c), mesh.position(f, (c + 1) % 3));
    const double length2 = dot_product(d, d);
    if (length2 <= longest) continue;
    longest = length2;
    best = (c + 2) % 3;
  }
  return best;
}

}  // namespace

std::array<int, 2> Tile::corner_texel(int corner) const {
  const int k = slot(corner);
  return {k == 1 ? size - 1 : 0, k == 2 ? size - 1 : 0};
}

std::array<int, 2> Tile::side_texel(int from_corner, int to_corner, int step) const {
  const auto [i0, j0] = corner_texel(from_corner);
  const auto [i1, j1] = corner_texel(to_corner);
  const auto sign = [](int d) { return d > 0 ? 1 : d < 0 ? -1 : 0; };
  return {i0 + sign(i1 - i0) * step, j0 + sign(j1 - j0) * step};
}

Vec3d Tile::center_weights(int i, int j) const {
  const double d = size;
  const double at_slot[3] = {1 - (i + j + 1) / d, (i + 0.5) / d, (j + 0.5) / d};
  return {at_slot[slot(0)], at_slot[slot(1)], at_slot[slot(2)]};
}

std::array<int, 2> Tile::nearest_texel(const Vec3d& weights) const {
  const double w[3] = {weights.x, weights.y, weights.z};
  // Products with a power of two are exact.
  const double a = w[(right_corner + 1) % 3] * size, b = w[(right_corner + 2) % 3] * size;
  int i = std::min(static_cast<int>(a), size - 1), j = std::min(static_cast<int>(b), size - 1);
  // On the hypotenuse, at its integer points; by the weights' rounding also just beyond it.
  while (i + j >= size) (j > 0 ? j : i) -= 1;
  return {i, j};
}

std::uint64_t Atlas::inside_count() const {
  std::uint64_t count = 0;
  for (const Tile& tile : tiles) count += texels_of_size(static_cast<std::uint64_t>(tile.size));
  return count;
}

std::uint64_t Atlas::border_count() const {
  std::uint64_t count = 0;
  for (const Tile& tile : tiles) count += gutter ? border_texels(tile.size, *gutter) : 0;
  return count;
}

Atlas make_atlas(const std::vector<double>& ratios, int width, int height, Gutter gutter) {
  const TriangleSizes sizes = choose_sizes(ratios, width, height, {}, gutter);
  Atlas atlas{.width = width, .height = height, .reductions = sizes.reductions, .handed_down = sizes.handed_down, .gutter = gutter};
  for (const int size : sizes.sizes) atlas.tiles.push_back({.size = size});
  place_tiles(atlas);
  return atlas;
}

Atlas make_atlas(const Mesh& mesh, double spacing, int width, int height, Gutter gutter) {
  Atlas atlas = make_atlas(size_ratios(mesh, spacing), width, height, gutter);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) atlas.tiles[f].right_corner = corner_of_right_angle(mesh, FaceId(f));
  return atlas;
}

double drawn_in_share(const Atlas& atlas) {
  int least = atlas.width;
  for (const Tile& tile : atlas.tiles) least = std::min(least, tile.size);
  // 8 units of 2^-24 of the longer side of the map, for its smallest triangle.
  return std::max(0x1p-13, 0x1p-21 * std::max(atlas.width, atlas.height) / least);
}

Vec2d corner_place(const Tile& tile, int corner, double share) {
  const double d = tile.size, in = share * d;
  // The sides x = in, y = in and x + y = d − √2·in.
  const double far = d - in - std::sqrt(2.0) * in;
  const int k = tile.slot(corner);
  const double a = k == 1 ? far : in, b = k == 2 ? far : in;
  return tile.turned ? Vec2d{tile.x + d - a, tile.y + d + 1 - b} : Vec2d{tile.x + a, tile.y + b};
}

}  // namespace etalon::bake
