// Painting a mesh's texture: which point of which face each texel shows, then a colour for each, then gutters.
#pragma once

#include <functional>

#include "core/image/image.h"
#include "core/mesh/mesh.h"

namespace etalon::procedural {

/// A texel centre on a face: weights of the face's corners 0, 1, 2 (they sum to 1).
struct TexelOnFace {
  FaceId face;
  double weight[3];
};

/// Calls `paint` once for every texel whose centre lies in a face's UV triangle (in several: the lowest face), from several threads, and
/// stores its colour; texels of no face take the mean of their already coloured 8-neighbours, ring by ring, up to `gutter_texel` rings,
/// and `background` beyond.
[[nodiscard]] Image bake_atlas(const Mesh& mesh, int size, int gutter_texel, const Vec3d& background,
                               const std::function<Vec3d(const TexelOnFace&)>& paint);

}  // namespace etalon::procedural
