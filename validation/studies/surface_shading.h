// Light on a surface, as vertex colours that any renderer interpolates: grey by one distant lamp, flat or smooth.
#pragma once

#include "core/image/image.h"
#include "core/mesh/mesh.h"

namespace etalon::validation {

/// Grey ¼ + ¾·max(0, n·l) of each face, l towards the lamp (any length above 0); each face has vertices of its own. Faces without area are dark.
[[nodiscard]] Mesh flat_shaded(const Mesh& mesh, const Vec3d& to_lamp);
/// The same at vertices, whose normals are the sums of their faces' area vectors; interpolated between them.
[[nodiscard]] Mesh smooth_shaded(const Mesh& mesh, const Vec3d& to_lamp);

/// Two RGB unorm8 pictures of one size multiplied texel by texel, 255 being 1, rounded to nearest.
[[nodiscard]] Image multiplied(const Image& color, const Image& light);

}  // namespace etalon::validation
