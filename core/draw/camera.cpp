#include "core/draw/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/base/error.h"
#include "core/base/float_environment.h"

namespace etalon {
namespace {

double dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3d cross(const Vec3d& a, const Vec3d& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Vec3d minus(const Vec3d& a, const Vec3d& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

Vec3d normalized(const Vec3d& a, const char* what) {
  const double length = std::sqrt(dot(a, a));
  if (!(length > 0) || !std::isfinite(length)) throw InputError(fmt::format("view: {}", what));
  return {a.x / length, a.y / length, a.z / length};
}

struct Sphere {
  Vec3d center{0, 0, 0};
  double radius = 1;
};

// The ball around the box: half the diagonal; 1 for a single point.
Sphere bounding_sphere(const BoundingBox& box) {
  Sphere s;
  s.center = {0.5 * (double{box.lo.x} + box.hi.x), 0.5 * (double{box.lo.y} + box.hi.y), 0.5 * (double{box.lo.z} + box.hi.z)};
  const double radius = 0.5 * box.diagonal();
  if (radius > 0) s.radius = radius;
  return s;
}

Camera camera_from(const Sphere& sphere, const Vec3d& direction, double distance) {
  Camera camera;
  const Vec3d d = normalized(direction, "a direction of length 0");
  camera.target = sphere.center;
  camera.eye = {sphere.center.x + d.x * distance, sphere.center.y + d.y * distance, sphere.center.z + d.z * distance};
  camera.near = std::max(distance - sphere.radius * 1.0625, distance * 0x1p-6);
  camera.far = distance + sphere.radius * 1.0625;
  return camera;
}

// The nearest view from `direction` in which the box's eight corners stay inside 15/16 of the frame.
Camera filling_view(const BoundingBox& box, const Vec3d& direction, double aspect) {
  constexpr double kTan = 0.25, kFilled = 0.9375;
  const Sphere sphere = bounding_sphere(box);
  const Vec3d back = normalized(direction, "a direction of length 0");
  const Vec3d right = normalized(cross({0, 1, 0}, back), "looking along the y axis");
  const Vec3d up = cross(back, right);
  double distance = sphere.radius * 0x1p-6;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p =
        minus({corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z}, sphere.center);
    // |x| <= kFilled·tan·aspect·(distance − depth), and so on.
    const double x = std::abs(dot(p, right)) / (kFilled * kTan * aspect), y = std::abs(dot(p, up)) / (kFilled * kTan);
    distance = std::max(distance, dot(p, back) + std::max(x, y));
  }
  Camera camera = camera_from(sphere, direction, distance);
  camera.tan_half_fov_y = kTan;
  return camera;
}

}  // namespace

Matrix4 clip_from_object(const Camera& camera, int width, int height) {
  const DefaultFloatEnvironment environment;
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(camera.eye[i]) || !std::isfinite(camera.target[i]) || !std::isfinite(camera.up[i]))
      throw InputError("view: eye, target and up must be finite");
  if (!(camera.tan_half_fov_y > 0) || !std::isfinite(camera.tan_half_fov_y)) throw InputError("view: tan_half_fov_y must be above 0");
  if (!(camera.near > 0) || !(camera.far > camera.near) || !std::isfinite(camera.far))
    throw InputError(fmt::format("view: expected 0 < near < far, got near {} and far {}", camera.near, camera.far));
  const Vec3d back = normalized(minus(camera.eye, camera.target), "eye and target are the same point");
  const Vec3d right = normalized(cross(camera.up, back), "up is parallel to the direction of view");
  const Vec3d up = cross(back, right);

  const double fy = 1 / camera.tan_half_fov_y;
  const double fx = fy * static_cast<double>(height) / static_cast<double>(width);
  const double depth = camera.far - camera.near;
  const double zz = -(camera.far + camera.near) / depth, zt = -2 * camera.far * camera.near / depth;
  // Clip space knows no unit: where the view's own would leave the contract's range of w, all four coordinates are scaled by one power of
  // two, which rounds nothing and changes no texel, to far in [2^9, 2^10).
  double unit = 1;
  if (camera.near < 0x1p-20 || camera.far > 0x1p20) {
    while (camera.far * unit >= 0x1p10) unit *= 0.5;
    while (camera.far * unit < 0x1p9) unit *= 2;
  }
  Matrix4 m;
  const auto row = [&](int r, const Vec3d& axis, double scale, double extra) {
    for (int c = 0; c < 3; ++c) m.m[r][c] = axis[c] * scale * unit;
    m.m[r][3] = (-dot(axis, camera.eye) * scale + extra) * unit;
  };
  row(0, right, fx, 0);
  row(1, up, fy, 0);
  row(2, back, zz, zt);
  row(3, back, -1, 0);
  return m;
}

Camera view_of_24(const BoundingBox& box, int index) {
  if (index < 0 || index >= 24) throw InputError(fmt::format("view: expected 0/24 to 23/24, got {}/24", index));
  // Permutations of (0, ±1, ±2): which axis is 0, which of the other two is ±2, and two signs.
  const int zero = index / 8, swap = index / 4 % 2, sign1 = index / 2 % 2, sign2 = index % 2;
  Vec3d direction{0, 0, 0};
  direction[(zero + 1 + swap) % 3] = sign1 == 0 ? 1 : -1;
  direction[(zero + 2 - swap) % 3] = sign2 == 0 ? 2 : -2;
  const Sphere sphere = bounding_sphere(box);
  Camera camera = camera_from(sphere, direction, 2.5 * sphere.radius);
  camera.tan_half_fov_y = 0.5;
  return camera;
}

Camera named_view(const std::string& name, const BoundingBox& box, int width, int height) {
  const auto slash = name.find("/24");
  if (slash != std::string::npos && slash + 3 == name.size()) {
    int index = -1;
    const auto [end, error] = std::from_chars(name.data(), name.data() + slash, index);
    if (error == std::errc() && end == name.data() + slash) return view_of_24(box, index);
  }
  if (name != "front" && name != "fit") throw InputError(fmt::format("view: expected front, fit, N/24 or a file, got '{}'", name));
  return filling_view(box, name == "front" ? Vec3d{0, 0, 1} : Vec3d{0.75, 0.375, 1},
                      static_cast<double>(width) / static_cast<double>(height));
}

}  // namespace etalon
