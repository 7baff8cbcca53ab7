#include "core/mesh/mesh.h"

#include <algorithm>
#include <cmath>

namespace etalon {

double BoundingBox::diagonal() const {
  if (lo.x > hi.x) return 0;
  const double dx = static_cast<double>(hi.x) - lo.x;
  const double dy = static_cast<double>(hi.y) - lo.y;
  const double dz = static_cast<double>(hi.z) - lo.z;
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

BoundingBox bounding_box(const Mesh& mesh) {
  BoundingBox box;
  if (mesh.positions.empty()) return box;
  box.lo = box.hi = mesh.positions.front();
  for (const Vec3f& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], p[axis]);
      box.hi[axis] = std::max(box.hi[axis], p[axis]);
    }
  return box;
}

}  // namespace etalon
