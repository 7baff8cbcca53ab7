// A model's texture at its vertices: what makes a coloured scan of a textured model.
#pragma once

#include <vector>

#include "core/draw/renderer.h"
#include "core/draw/scene.h"

namespace etalon::validation {

/// One colour a vertex, RGBA in [0, 1], whole 255ths: the texture of the first face at the vertex, by nearest lookup at that face's coordinate, wrapped as
/// the material's sampler says. `exact` draws it, one texel a vertex, so texels of any format are read as drawings read them. Vertices of no
/// face, and of faces whose material has no texture, are mid grey. `materials` as of make_scene(); the mesh has texture coordinates.
/// InputError: a coordinate breaks the contract's ranges, more than 2^28 vertices.
[[nodiscard]] std::vector<Vec4f> texture_at_vertices(const Mesh& mesh, const std::vector<Material>& materials, Renderer& exact);

}  // namespace etalon::validation
