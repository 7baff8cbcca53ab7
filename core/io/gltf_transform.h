// The transforms of glTF nodes, in double. Not for use outside core/io.
#pragma once

#include "core/io/gltf_document.h"
#include "core/math/vec.h"

namespace etalon::io {

/// Affine map: columns 0..2 are the linear part, column 3 the translation.
struct NodeTransform {
  Vec3d column[4] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  bool identity = true;

  [[nodiscard]] Vec3d linear(const Vec3d& d) const { return column[0] * d.x + column[1] * d.y + column[2] * d.z; }
  [[nodiscard]] Vec3f point(const Vec3f& p) const { return identity ? p : Vec3f(linear(Vec3d(p)) + column[3]); }
  [[nodiscard]] bool mirrors() const {
    const Vec3d &a = column[0], &b = column[1], &c = column[2];
    return a.x * (b.y * c.z - b.z * c.y) - b.x * (a.y * c.z - a.z * c.y) + c.x * (a.y * b.z - a.z * b.y) < 0;
  }
  [[nodiscard]] NodeTransform after(const NodeTransform& first) const {
    if (identity) return first;
    if (first.identity) return *this;
    NodeTransform result;
    for (int i = 0; i < 3; ++i) result.column[i] = linear(first.column[i]);
    result.column[3] = linear(first.column[3]) + column[3];
    result.identity = false;
    return result;
  }
};

/// The node's own transform (glTF 2.0, 3.5.3): `matrix` (column-major), or translation · rotation (unit quaternion x y z w) · scale.
[[nodiscard]] NodeTransform local_transform(const JsonRef& node);

}  // namespace etalon::io
