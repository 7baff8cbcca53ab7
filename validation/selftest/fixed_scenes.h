// A fixed set of drawings that together visit every decision, every kernel and every storage format of the rasterizer.
// Their bytes have one SHA-256 on every machine: data/golden/hash_scenes.sha256, changed only with kRasterContractVersion or with this set.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/draw/draw_list.h"

namespace etalon::validation {

struct FixedScene {
  std::string name;
  DrawList list;
  Frame frame;
};

/// Scenes about one question; they are hashed together.
struct SceneFamily {
  std::string name;
  std::vector<FixedScene> scenes;
};

/// The same scenes on every machine, about 17 million channel values in all; made from seeds, without a file:
///   shading    vertex colours, nearest, linear, and the four indexed lookups; affine, equal w and perspective; every format of targets
///   textures   every format of textures and of indexing maps, nearest and linear
///   wraps      the nine pairs of wraps; textures of one texel up to 1024 × 3 and 2 × 4099; coordinates up to 2^29 texels
///   values     attributes up to 2^40, subnormal texels, w from 2^-20 to 2^20, the borders of half, unorm and sRGB
///   targets    every content alone in every format it may have, and all together
///   grids      sub-texel bits 1 to 16, the four fill rules, culling, depth test on and off
///   far        vertices as far as positions go, frames of 16384 texels
///   tiny       tens of thousands of triangles below a texel, shared vertices, crossing depths
///   slivers    fans and needles without a whole texel of width
///   ties       textures shifted by half texels, values half way between two stored ones, coplanar and touching depths
///   sizes      frames of one texel up to a few tiles, around every power of two
///   passes     thousands of small fans that copy one map into another
///   random     all of it by chance
///   models     the procedural head and swirl, through camera, clip and snap
[[nodiscard]] std::vector<SceneFamily> fixed_scenes();

/// A scene by chance over the same domain, for the judge: 48 × 40 texels or less, a few targets, up to 16 triangles.
[[nodiscard]] FixedScene judged_scene(std::uint64_t seed);

}  // namespace etalon::validation
