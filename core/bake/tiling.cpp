#include "core/bake/tiling.h"

#include <algorithm>
#include <map>
#include <queue>
#include <tuple>

namespace etalon::bake {

SizeCounts even_counts(SizeCounts counts) {
  const auto used = [&](int k) { return counts[static_cast<std::size_t>(k)] > 0; };
  int lowest = 0;
  while (lowest < kSizeCount && !used(lowest)) ++lowest;
  for (int k = kSizeCount - 1; k > lowest; --k) {
    auto& count = counts[static_cast<std::size_t>(k)];
    if (count % 2 == 0) continue;
    --count;
    ++counts[static_cast<std::size_t>(k) - 1];
  }
  return counts;
}

std::uint64_t tiling_height(const SizeCounts& counts, int width) {
  // The skyline as a multiset: how many columns of the present size end at which row. Which of equal columns is taken does not matter.
  std::map<std::uint64_t, std::uint64_t> columns;
  std::uint64_t column_width = static_cast<std::uint64_t>(width);
  columns[0] = 1;
  for (int k = kSizeCount - 1; k > 0; --k) {
    std::uint64_t left = (counts[static_cast<std::size_t>(k)] + 1) / 2;
    if (left == 0) continue;
    const std::uint64_t size = std::uint64_t{1} << k;
    for (auto& [row, count] : columns) count *= column_width / size;
    column_width = size;
    while (left > 0) {
      const auto [row, count] = *columns.begin();
      const std::uint64_t taken = std::min(left, count);
      if (taken == count)
        columns.erase(columns.begin());
      else
        columns.begin()->second -= taken;
      columns[row + size + 1] += taken;
      left -= taken;
    }
  }
  return columns.rbegin()->first;
}

std::uint64_t least_height(std::uint64_t triangles, int width) {
  const std::uint64_t pairs = (triangles + 1) / 2, in_row = static_cast<std::uint64_t>(width) / 2;
  return 3 * ((pairs + in_row - 1) / in_row);
}

std::uint64_t least_square(std::uint64_t triangles) {
  std::uint64_t side = 4;
  while (least_height(triangles, static_cast<int>(side)) > side) side *= 2;
  return side;
}

std::vector<Place> tile_rectangles(const std::vector<int>& widths, int width) {
  // Free columns by (row, x); a block wider than the rectangle gives its left half.
  using Block = std::tuple<std::uint64_t, int, int>;  // top, x, width
  std::priority_queue<Block, std::vector<Block>, std::greater<>> free;
  free.emplace(0, 0, width);
  std::vector<Place> places;
  places.reserve(widths.size());
  for (const int wanted : widths) {
    auto [top, x, block] = free.top();
    free.pop();
    while (block > wanted) {
      block /= 2;
      free.emplace(top, x + block, block);
    }
    places.push_back({x, top});
    free.emplace(top + static_cast<std::uint64_t>(wanted) + 1, x, wanted);
  }
  return places;
}

}  // namespace etalon::bake
