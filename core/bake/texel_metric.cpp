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

double TexelPlane::least_step() const {
  // The least |a + y·b|, |y| ≤ 1: with the larger of the two index differences ±k the other is within ±k.
  const auto least = [](const Vec3d& a, const Vec3d& b) {
    const Vec3d from{a.x - b.x, a.y - b.y, a.z - b.z}, to{a.x + b.x, a.y + b.y, a.z + b.z};
    const double t = nearest_on_segment({0, 0, 0}, from, to);
    const Vec3d q{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y), from.z + t * (to.z - from.z)};
    return std::sqrt(dot_product(q, q));
  };
  const double size = std::sqrt(std::max(dot_product(along_i, along_i), dot_product(along_j, along_j)));
  // Less the rounding of all this: 2^-40 of the steps.
  return std::max(0.0, std::min(least(along_i, along_j), least(along_j, along_i)) - 0x1p-40 * size);
}

}  // namespace etalon::bake
