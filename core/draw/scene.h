// From a mesh to a draw list: transform, clip, then snap; once, for both renderers (docs/contract.md#clip-then-snap).
#pragma once

#include <memory>
#include <vector>

#include "core/draw/camera.h"
#include "core/draw/draw_list.h"

namespace etalon {

/// How the faces of one material are shaded.
struct Material {
  std::shared_ptr<const Image> texture;  ///< none: vertex colours
  Sampler sampler{Filter::nearest, Wrap::repeat, Wrap::repeat};
  std::shared_ptr<const Image> indexing_map;  ///< set: the texture is read through this map
  Sampler map_sampler;
};

/// Perspective drawing of a mesh. Faces keep their order; a face clipped into several triangles keeps them together; source_faces is filled.
/// `materials` is indexed by Mesh::face_materials and must not be empty; a face whose material has no texture takes vertex colours
/// (mid grey where the mesh has none). InputError where the camera or the mesh breaks the contract's ranges.
[[nodiscard]] DrawList make_scene(const Mesh& mesh, const std::vector<Material>& materials, const Camera& camera, const Frame& frame);

/// Affine drawing in texture space: every face at its own uv on the frame (u·width, v·height), z = 0, w = 1.
/// uv of the vertices is `uv` itself, so that a texture is copied texel by texel.
[[nodiscard]] DrawList make_uv_scene(const Mesh& mesh, const std::vector<Material>& materials, const Frame& frame);

/// One position in texels brought to the grid: round(x · 2^bits) by `rounding`. InputError when outside ±2^30 sub-texels or not finite.
[[nodiscard]] std::int32_t snap(double x_texel, const RasterState& state);

}  // namespace etalon
