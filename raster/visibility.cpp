#include "raster/visibility.h"

#include <algorithm>

#include "core/math/quotient.h"

namespace etalon::raster {
namespace {

// The exact quotient, only reached where double cannot decide: E < 2^62 and z an integer of at most 64 bits, so 4 limbs hold all.
float exact_depth(const EdgeValues& e, std::int64_t area2, const ExactTriple& z) {
  WideInt<4> n;
  for (int i = 0; i < 3; ++i) n += WideInt<4>(e[i]) * WideInt<4>(z.m[i]);
  const Quotient<4> q{n, WideInt<4>(area2), z.k};
  return to_float32(q, enclose(q));
}

}  // namespace

float stored_depth(const EdgeValues& e, std::int64_t area2, const ExactTriple& z) {
  // All terms are >= 0: conversions, products, sums and the division err by less than 8·2^-53 = 2^-50 relative.
  const double n = static_cast<double>(e[0]) * z.value[0] + static_cast<double>(e[1]) * z.value[1] + static_cast<double>(e[2]) * z.value[2];
  const double depth = n / static_cast<double>(area2);
  const float lo = static_cast<float>(depth * (1 - 0x1p-49)), hi = static_cast<float>(depth * (1 + 0x1p-49));
  return lo == hi ? lo : exact_depth(e, area2, z);
}

void resolve_visibility(const DrawList& list, const Frame& frame, const Tile& tile, std::span<const std::uint32_t> ids, bool keep_runner_up,
                        TileVisibility& result) {
  const auto texels = static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height);
  result.triangle.assign(texels, kNoTriangle);
  result.depth.assign(texels, 1.0f);
  if (keep_runner_up) result.runner_up.assign(texels, std::numeric_limits<float>::infinity());
  const bool test = frame.state.depth_test;
  for (const std::uint32_t id : ids) {
    const auto& corner = list.triangles[id];
    const RasterVertex& v0 = list.vertices[corner[0]];
    const RasterVertex& v1 = list.vertices[corner[1]];
    const RasterVertex& v2 = list.vertices[corner[2]];
    const Edges edges = make_edges(v0, v1, v2, frame);
    if (edges.area2 == 0) continue;
    const ExactTriple z = exact_triple(v0.z, v1.z, v2.z);
    const int j_end = std::min(edges.j_max, tile.y0 + tile.height - 1);
    for (int j = std::max(edges.j_min, tile.y0); j <= j_end; ++j) {
      const auto span = edges.span(j);
      const int first = std::max(span[0], tile.x0), last = std::min(span[1], tile.x0 + tile.width - 1);
      if (first > last) continue;
      EdgeValues e = edges.at(first, j);
      std::size_t at =
          static_cast<std::size_t>(j - tile.y0) * static_cast<std::size_t>(tile.width) + static_cast<std::size_t>(first - tile.x0);
      for (int i = first; i <= last; ++i, ++at) {
        const float depth = stored_depth(e, edges.area2, z);
        for (int k = 0; k < 3; ++k) e[k] -= edges.dy[k] << edges.subtexel_bits;
        if (!test) {
          result.triangle[at] = id, result.depth[at] = depth;
        } else if (depth < result.depth[at]) {
          if (keep_runner_up && result.triangle[at] != kNoTriangle) result.runner_up[at] = result.depth[at];
          result.triangle[at] = id, result.depth[at] = depth;
        } else if (keep_runner_up && depth < 1 && depth < result.runner_up[at] && result.triangle[at] != kNoTriangle) {
          result.runner_up[at] = depth;
        }
      }
    }
  }
}

}  // namespace etalon::raster
