// A view of a terrain as plain numbers, and what a metre of height is worth in it: pixels of the screen.
#pragma once

#include <vector>

#include "core/math/vec.h"
#include "core/terrain/height_field.h"

namespace etalon::terrain {

/// The fields of a view file (`etalon/view/1`) and the frame's size. Positions in the model space of HeightField.
struct TerrainView {
  Vec3d eye{0, 1, 0};
  Vec3d target{0, 0, 0};
  Vec3d up{0, 1, 0};
  double tan_half_fov_y = 0.5;
  double near = 0.1;
  double far = 100;
  int width = 640, height = 480;
  friend bool operator==(const TerrainView&, const TerrainView&) = default;
};

/// The view's axes and limits, from + − × ÷ √ in written order.
class ViewFrustum {
 public:
  /// InputError: eye = target, up parallel to the view, near <= 0, far <= near, tan_half_fov_y <= 0, a number that is not finite, a frame of
  /// less than 1 or more than 32768 pixels on a side.
  explicit ViewFrustum(const TerrainView& view);

  /// Inside: near <= depth <= far and on the frame, borders included. Occlusion is not looked at.
  [[nodiscard]] bool contains(const Vec3d& p) const;
  /// Pixels by which the picture of p moves for each metre that p is raised (the derivative at p), >= 0; 0 outside the frustum.
  [[nodiscard]] double pixels_per_metre(const Vec3d& p) const;

 private:
  Vec3d eye_, right_, up_, forward_;
  double near_ = 0, far_ = 0, tan_x_ = 0, tan_y_ = 0, scale_px_ = 0;
};

/// pixels_per_metre of every grid point, in their order.
[[nodiscard]] std::vector<double> screen_weights(const HeightField& field, const TerrainView& view);

}  // namespace etalon::terrain
