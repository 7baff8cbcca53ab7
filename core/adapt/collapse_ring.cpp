#include "core/adapt/collapse_ring.h"

#include "core/math/nearest_point.h"
#include "core/mesh/exact_orientation.h"

namespace etalon::adapt {

bool is_unfolded(const CollapseRing& ring) {
  const std::size_t n = ring.size();
  const auto before = [&](std::size_t k) -> const Vec2f& { return k == 0 ? ring.target_before() : ring.uv[k]; };
  for (std::size_t k = 0; k < ring.triangles_before(); ++k)
    if (orientation(ring.uv_of_u, before(k), before((k + 1) % n)) <= 0) return false;
  for (std::size_t k = 1; k + 1 < n; ++k)
    if (orientation(ring.uv[0], ring.uv[k], ring.uv[k + 1]) <= 0) return false;
  return true;
}

Vec2d new_place_of_u(const CollapseRing& ring) {
  const Vec3d u = to_double(ring.position_of_u), v = to_double(ring.positions[0]);
  const Vec2d uv_of_v(ring.uv[0]);
  if (ring.on_curve) {
    const double t = nearest_on_segment(u, v, to_double(ring.positions.back()));
    return uv_of_v + t * (Vec2d(ring.uv.back()) - uv_of_v);
  }
  NearestOnTriangle nearest;
  std::size_t triangle = 0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    const NearestOnTriangle here = nearest_on_triangle(u, v, to_double(ring.positions[k]), to_double(ring.positions[k + 1]));
    if (triangle == 0 || here.distance2 < nearest.distance2) nearest = here, triangle = k;
  }
  return uv_of_v + nearest.weights.y * (Vec2d(ring.uv[triangle]) - uv_of_v) + nearest.weights.z * (Vec2d(ring.uv[triangle + 1]) - uv_of_v);
}

}  // namespace etalon::adapt
