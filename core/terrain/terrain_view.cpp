#include "core/terrain/terrain_view.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace etalon::terrain {

namespace {

double dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3d cross(const Vec3d& a, const Vec3d& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

Vec3d unit_vector(const Vec3d& a, const char* what) {
  const double length = std::sqrt(dot(a, a));
  if (!(length > 0) || !std::isfinite(length)) throw InputError(fmt::format("view: {}", what));
  return {a.x / length, a.y / length, a.z / length};
}

}  // namespace

ViewFrustum::ViewFrustum(const TerrainView& view) : eye_(view.eye), near_(view.near), far_(view.far) {
  if (!(view.near > 0) || !(view.far > view.near) || !std::isfinite(view.far))
    throw InputError(fmt::format("view: expected 0 < near < far, got {} and {}", view.near, view.far));
  if (!(view.tan_half_fov_y > 0) || !std::isfinite(view.tan_half_fov_y))
    throw InputError(fmt::format("view: expected tan_half_fov_y above 0, got {}", view.tan_half_fov_y));
  if (view.width < 1 || view.height < 1 || view.width > kMaxImageSize || view.height > kMaxImageSize)
    throw InputError(fmt::format("view: expected a frame of 1x1 to {0}x{0} pixels, got {1}x{2}", kMaxImageSize, view.width, view.height));
  forward_ = unit_vector(Vec3d(view.target.x - view.eye.x, view.target.y - view.eye.y, view.target.z - view.eye.z),
                         "expected a target away from the eye");
  right_ = unit_vector(cross(forward_, view.up), "expected an up direction that is not the view's own");
  up_ = cross(right_, forward_);
  tan_y_ = view.tan_half_fov_y;
  tan_x_ = view.tan_half_fov_y * view.width / view.height;
  scale_px_ = view.height / (2 * view.tan_half_fov_y);
}

bool ViewFrustum::contains(const Vec3d& p) const {
  const Vec3d e{p.x - eye_.x, p.y - eye_.y, p.z - eye_.z};
  const double depth = dot(e, forward_);
  return depth >= near_ && depth <= far_ && std::fabs(dot(e, right_)) <= depth * tan_x_ && std::fabs(dot(e, up_)) <= depth * tan_y_;
}

double ViewFrustum::pixels_per_metre(const Vec3d& p) const {
  if (!contains(p)) return 0;
  const Vec3d e{p.x - eye_.x, p.y - eye_.y, p.z - eye_.z};
  const double x = dot(e, right_), y = dot(e, up_), depth = dot(e, forward_);
  // d/dy of scale·x/depth and scale·y/depth, where p moves along (0, 1, 0).
  const double dx = (right_.y * depth - x * forward_.y) / (depth * depth);
  const double dy = (up_.y * depth - y * forward_.y) / (depth * depth);
  return scale_px_ * std::sqrt(dx * dx + dy * dy);
}

std::vector<double> screen_weights(const HeightField& field, const TerrainView& view) {
  const ViewFrustum frustum(view);
  std::vector<double> weights(field.point_count());
  parallel_for(static_cast<std::size_t>(field.side()), [&](std::size_t row) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < field.side(); ++i) weights[field.index(i, j)] = frustum.pixels_per_metre(field.position(i, j));
  });
  return weights;
}

}  // namespace etalon::terrain
