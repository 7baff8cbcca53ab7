// Where a removed vertex went: the point of a simplified surface that stands for it.
#pragma once

#include <vector>

#include "core/math/nearest_point.h"
#include "core/mesh/mesh.h"

namespace etalon {

/// A point of a mesh, as a face and weights of its corners (each in [0, 1], sum 1 up to rounding).
struct Landing {
  FaceId face;  ///< invalid for a vertex that no face used
  Vec3d weights{0, 0, 0};
  bool on_curve = false;  ///< it lies on an edge where the surface, its texture coordinates or a material end, and belongs there
};

/// The point in space, in model units.
[[nodiscard]] inline Vec3d landing_point(const Mesh& mesh, const Landing& landing) {
  const Vec3d a = to_double(mesh.position(landing.face, 0)), b = to_double(mesh.position(landing.face, 1)),
              c = to_double(mesh.position(landing.face, 2));
  return detail::at_weights({0, 0, 0}, a, b, c, landing.weights).point;
}

}  // namespace etalon
