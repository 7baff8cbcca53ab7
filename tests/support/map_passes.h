// Random passes over a map, for the tests of resident maps: groups in blocks of their own, triangles of a group over each other.
#pragma once

#include <vector>

#include "core/base/rng.h"
#include "core/draw/resident_map.h"

namespace etalon::test {

inline constexpr int kPassBlock_texel = 80;  ///< larger than a tile of the exact renderer

/// Each group has up to `most_triangles` in its block, some of them outside the map; coordinates in [0, 1].
inline MapPass random_map_pass(Rng& rng, int width, int height, int subtexel_bits, std::uint64_t most_triangles = 12) {
  MapPass pass;
  const auto place = [&](int block_start) {
    return static_cast<std::int32_t>(rng.between(block_start << subtexel_bits, (block_start + kPassBlock_texel) << subtexel_bits));
  };
  for (int y = -kPassBlock_texel / 2; y < height; y += kPassBlock_texel)
    for (int x = -kPassBlock_texel / 2; x < width; x += kPassBlock_texel) {
      if (rng.below(4) == 0) continue;
      for (std::uint64_t t = 1 + rng.below(most_triangles); t > 0; --t) {
        const auto first = static_cast<std::uint32_t>(pass.vertices.size());
        for (int k = 0; k < 3; ++k) {
          RasterVertex v;
          v.x = place(x), v.y = place(y);
          v.uv = {rng.uniform(0, 1), rng.uniform(0, 1)};
          pass.vertices.push_back(v);
        }
        pass.triangles.push_back({first, first + 1, first + 2});
      }
      pass.group_ends.push_back(static_cast<std::uint32_t>(pass.triangles.size()));
    }
  return pass;
}

}  // namespace etalon::test
