// How rectangles of paired half-square triangles fill a texture map, from the largest to the smallest, always at the highest free place
// [Soucy, Godin & Rioux 1996, sec. 3, figures 4 and 5].
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace etalon::bake {

/// How many triangles have size 2^k, k the index; sizes are at least 2.
inline constexpr int kSizeCount = 16;
using SizeCounts = std::array<std::uint64_t, kSizeCount>;

/// Texels of a half-square triangle of size d: each of its three sides has d of them.
[[nodiscard]] constexpr std::uint64_t texels_of_size(std::uint64_t d) { return d * (d + 1) / 2; }

/// The counts after every class but the lowest that has triangles was made even: from the largest down, an odd class hands one triangle to
/// the next lower class, which may have been empty.
[[nodiscard]] SizeCounts even_counts(SizeCounts counts);

/// Rows from the top that the tiling reaches down to, in a map of `width` texels, a power of two and at least the largest size. An odd
/// class takes a rectangle for its last triangle.
[[nodiscard]] std::uint64_t tiling_height(const SizeCounts& counts, int width);

/// The height of the lowest map of `width` that holds `triangles` triangles, all of size 2: 3·⌈⌈n/2⌉/(W/2)⌉.
[[nodiscard]] std::uint64_t least_height(std::uint64_t triangles, int width);
/// The side of the smallest square map, a power of two, that holds them.
[[nodiscard]] std::uint64_t least_square(std::uint64_t triangles);

/// Where a rectangle of width d and height d + 1 is: its first column, and its first row counted from the map's top.
struct Place {
  int x = 0;
  std::uint64_t top = 0;
  friend bool operator==(const Place&, const Place&) = default;
};

/// Places rectangles of the given widths (powers of two, none larger than the one before or than `width`): each at the highest free place,
/// the leftmost of those. Their union leaves nothing free above the skyline it ends in.
[[nodiscard]] std::vector<Place> tile_rectangles(const std::vector<int>& widths, int width);

}  // namespace etalon::bake
