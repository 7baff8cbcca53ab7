#include "core/bake/texel_metric.h"

#include <algorithm>

#include "core/math/nearest_point.h"

namespace etalon::bake {

TexelMetric::TexelMetric(const Mesh& mesh, const Atlas& atlas) : mesh_(mesh), atlas_(atlas) {
  const BoundingBox box = bounding_box(mesh);
  if (!(box.lo.x <= box.hi.x)) return;
  low_ = to_double(box.lo);
  const Vec3d sides = difference_of(box.lo, box.hi);
  const double longest = std::max({sides.x, sides.y, sides.z});
  int exponent = 0;
  if (longest > 0) (void)std::frexp(longest, &exponent);  // longest ≤ 2^exponent
  step_length_ = std::ldexp(1.0, exponent - 30);
}

TexelPlane TexelMetric::plane(std::uint32_t face) const {
  const Tile& tile = atlas_.tiles[face];
  const auto corner = [&](int slot) {
    const Vec3d p = to_double(mesh_.position(FaceId(face), (tile.right_corner + slot) % 3));
    return Vec3d{(p.x - low_.x) / step_length_, (p.y - low_.y) / step_length_, (p.z - low_.z) / step_length_};
  };
  const Vec3d a = corner(0), b = corner(1), c = corner(2);
  const double d = tile.size;
  return {a, {(b.x - a.x) / d, (b.y - a.y) / d, (b.z - a.z) / d}, {(c.x - a.x) / d, (c.y - a.y) / d, (c.z - a.z) / d}};
}

}  // namespace etalon::bake
