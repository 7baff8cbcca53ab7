// A perspective camera without trigonometry, and the scene (mesh + camera → draw list) both renderers receive.
#pragma once

#include "core/draw/draw_list.h"
#include "core/mesh/mesh.h"

namespace etalon {

/// A view (`etalon/view/1`). Positions in model units.
struct Camera {
  Vec3d eye{0, 0, 3};
  Vec3d target{0, 0, 0};
  Vec3d up{0, 1, 0};
  double tan_half_fov_y = 0.5;
  double near = 0.1;
  double far = 100;
};

/// Row-major 4×4 matrix in double: clip = m · (x, y, z, 1), products summed left to right.
struct Matrix4 {
  double m[4][4] = {};
};

/// The OpenGL clip matrix (z from −w to w) of the camera for an aspect of width / height. Only + − × ÷ √, in the written order.
/// InputError where the view is degenerate (eye = target, up parallel to the view, near <= 0, far <= near, not finite).
[[nodiscard]] Matrix4 clip_from_object(const Camera& camera, int width, int height);

/// The 24 views: directions are the permutations of (0, ±1, ±2), at 2.5 bounding-sphere radii, tan_half_fov_y 0.5, up +Y.
[[nodiscard]] Camera view_of_24(const BoundingBox& box, int index);
/// Named views: "front" (from +Z) and "fit" (three-quarter), the box filling the frame, or "N/24" of the 24 views. InputError for any other name.
[[nodiscard]] Camera named_view(const std::string& name, const BoundingBox& box, int width, int height);

}  // namespace etalon
