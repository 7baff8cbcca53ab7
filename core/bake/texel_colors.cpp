#include "core/bake/texel_colors.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"

namespace etalon::bake {

std::uint8_t color_byte(float channel) { return static_cast<std::uint8_t>(std::clamp(static_cast<double>(channel), 0.0, 1.0) * 255 + 0.5); }

TexelColors average_colors(const Atlas& atlas, const TexelNodes& nodes, const std::vector<Vec4f>& colors,
                           const std::vector<Landing>& landings) {
  if (colors.empty()) throw InputError("the scan has no vertex colours: there is nothing to bake");
  ETALON_CHECK(colors.size() == landings.size(), fmt::format("{} colours, {} landings", colors.size(), landings.size()));
  std::vector<std::array<std::uint64_t, 3>> sums(nodes.texel_count());
  TexelColors result{.color = std::vector<Rgb8>(nodes.texel_count()), .hits = std::vector<std::uint32_t>(nodes.texel_count())};
  for (std::size_t v = 0; v < colors.size(); ++v) {
    const Landing& landing = landings[v];
    if (!landing.face.valid()) {
      ++result.without_face;
      continue;
    }
    const Tile& tile = atlas.tiles[landing.face.index];
    const auto [i, j] = tile.nearest_texel(landing.weights);
    const std::uint32_t node = nodes.node_of(nodes.texel(landing.face.index, tile.size, i, j));
    for (int c = 0; c < 3; ++c) sums[node][static_cast<std::size_t>(c)] += color_byte(colors[v][c]);
    ++result.hits[node];
  }
  for (std::uint32_t t = 0; t < nodes.texel_count(); ++t) {
    const std::uint32_t node = nodes.node_of(t), count = result.hits[node];
    result.hits[t] = count;
    if (count == 0) continue;
    for (std::size_t c = 0; c < 3; ++c)
      result.color[t][c] = static_cast<std::uint8_t>((2 * sums[node][c] + count) / (2 * std::uint64_t{count}));
  }
  return result;
}

}  // namespace etalon::bake
