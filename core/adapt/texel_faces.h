// Which face of a mesh each texel of its texture belongs to, the texels around its charts included.
#pragma once

#include <cstdint>
#include <vector>

#include "core/draw/renderer.h"
#include "core/mesh/mesh.h"

namespace etalon::adapt {

struct TexelFaces {
  int width = 0, height = 0;
  std::vector<std::uint32_t> faces;  ///< #texels, rows from v = 0 up; kNoTriangle where there is none
  std::vector<Vec3d> weights;        ///< #texels: of the face's corners at the texel's centre; outside [0, 1] in the gutter
};

/// A texel belongs to the face that covers its centre (the last of several), else, up to `gutter` texels away in either direction, to that of
/// the nearest texel which has one (ties: the first in row order), whose plane is continued; a face so thin that this leads more than its
/// own size away gives the weights of that texel instead. Coverage is the renderer's, weights are in double. InputError as make_uv_scene() and
/// validate(): texture coordinates far outside [0, 1].
[[nodiscard]] TexelFaces texel_faces(Renderer& renderer, const Mesh& mesh, int width, int height, int gutter);

}  // namespace etalon::adapt
