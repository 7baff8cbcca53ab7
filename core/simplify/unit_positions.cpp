#include "core/simplify/unit_positions.h"

#include <algorithm>
#include <cmath>

namespace etalon::simplify {

UnitPositions unit_positions(const CollapseMesh& mesh) {
  const BoundingBox box = bounding_box(mesh.source());
  const double longest = std::max(
      {static_cast<double>(box.hi.x) - box.lo.x, static_cast<double>(box.hi.y) - box.lo.y, static_cast<double>(box.hi.z) - box.lo.z});
  int exponent = 0;
  if (longest > 0) std::frexp(longest, &exponent);
  if (longest > 0 && std::ldexp(1.0, exponent - 1) == longest) --exponent;
  UnitPositions result;
  result.unit = std::ldexp(1.0, exponent);
  const double scale = std::ldexp(1.0, -exponent);
  if (longest > 0) result.longest = longest * scale;
  result.at.resize(mesh.vertex_capacity());
  for (std::uint32_t v = 0; v < mesh.vertex_capacity(); ++v) {
    const Vec3f& p = mesh.position(v);
    result.at[v] = {static_cast<float>(p.x * scale), static_cast<float>(p.y * scale), static_cast<float>(p.z * scale)};
  }
  return result;
}

}  // namespace etalon::simplify
