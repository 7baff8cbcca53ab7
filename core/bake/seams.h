// Whether a texture is continuous over the mesh: what section 2 of the paper asks for, measured on the finished image.
#pragma once

#include "core/bake/atlas.h"
#include "core/image/image.h"

namespace etalon::bake {

/// The largest difference, 0 to 255 in any channel, between two texels that show the same piece of an edge or the same vertex in different
/// triangles. Reads nothing but the mesh, the tiles and the image, whose format is three or four channels of unorm8.
[[nodiscard]] int largest_seam_residual(const Mesh& mesh, const Atlas& atlas, const Image& image);

}  // namespace etalon::bake
