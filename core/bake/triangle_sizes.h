// How large each triangle is in the texture map: as its longest edge and the scan's spacing ask, then smaller until all fit
// [Soucy, Godin & Rioux 1996, sec. 3].
#pragma once

#include <functional>
#include <vector>

#include "core/bake/gutter.h"
#include "core/mesh/mesh.h"

namespace etalon::bake {

/// Largest side of a texture map, texels: that of the largest frame (docs/contract.md#input).
inline constexpr int kLargestMap = 16384;

/// D_i: the mean length of the edges of the scan, each counted once, in model units; 0 for a mesh without edges of length above 0.
[[nodiscard]] double mean_edge_length(const Mesh& mesh);

/// #F: E_max / D_i, the longest edge of each triangle over the spacing, `spacing` > 0.
[[nodiscard]] std::vector<double> size_ratios(const Mesh& mesh, double spacing);

/// The smallest power of two that is not below `ratio`, from `least` to `largest` (powers of two).
[[nodiscard]] int wanted_size(double ratio, int largest, int least = 2);
/// The largest size whose rectangle, d × (d + 1) or pair_block(), a map can hold; InputError for a map that none can be in: width is a power of
/// two, 2 to kLargestMap, height 3 to kLargestMap, with a gutter for N levels, 0 to 8, a multiple of 2^N.
[[nodiscard]] int largest_size(int width, int height, Gutter gutter = {});

/// One step of the filtering: `face` goes from size `from` to half of it; proximity: its ratio over that half.
struct SizeStep {
  FaceId face;
  int from = 0;
  double proximity = 0;
};

struct TriangleSizes {
  std::vector<int> sizes;       ///< #F: powers of two, at least least_size(); every class but the lowest is even
  std::size_t reductions = 0;   ///< steps of the filtering
  std::size_t handed_down = 0;  ///< steps for the sake of even classes
};

/// The sizes for a map of width × height texels. While the tiling (with even classes) is higher than the map, the triangle of least
/// proximity, ties to the lower face, goes to half its size; at last every odd class but the lowest hands its triangle of least proximity
/// to the next lower one. `observe` sees the steps of the filtering. InputError, with the smallest map that would do, where the triangles
/// do not fit at the least size; for a map that largest_size() refuses; for a ratio that is not finite.
[[nodiscard]] TriangleSizes choose_sizes(const std::vector<double>& ratios, int width, int height,
                                         const std::function<void(const SizeStep&)>& observe = {}, Gutter gutter = {});

}  // namespace etalon::bake
