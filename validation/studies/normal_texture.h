// A normal map in object space: what a bumpy surface's normals are, texel by texel, as colours.
#pragma once

#include "core/draw/renderer.h"
#include "core/mesh/mesh.h"

namespace etalon::validation {

/// RGB unorm8, (n + 1)/2 of the unit normals: those of the vertices (faces' normals by area), interpolated; where `tangent` is given (a
/// normal map in tangent space, RGB or RGBA unorm8, green along v), bent by it: then of its size, else size × size. Charts have a gutter of
/// 4 texels; other texels point to +Z. In object space a normal stays what it is on a mesh of fewer faces, which a tangent frame does not.
/// InputError where the mesh has no texture coordinates or the map's format is another.
[[nodiscard]] Image object_normals(Renderer& renderer, const Mesh& mesh, const Image* tangent, int size);

/// A drawing of such a texture as a lit surface: grey, by a light from `toward_light` (any length) and a little from everywhere else.
/// RGBA unorm8 as drawn; alpha stays.
[[nodiscard]] Image lit_by_normals(const Image& drawn_normals, const Vec3d& toward_light);

}  // namespace etalon::validation
