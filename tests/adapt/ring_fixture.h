// Rings of collapses for tests.
#pragma once

#include "core/adapt/collapse_ring.h"
#include "core/adapt/edge_ring.h"
#include "core/base/rng.h"

namespace etalon::test {

/// An unfolded ring with random corners around u: in space anywhere, or (planar) in one plane where the triangles are unfolded too, but
/// other ones than in the texture.
[[nodiscard]] adapt::CollapseRing random_ring(Rng& rng, int corners, bool planar, bool on_curve);

/// Likewise for the collapse of an edge; at least 4 corners.
[[nodiscard]] adapt::EdgeRing random_edge_ring(Rng& rng, int corners, bool planar);

/// A triangle of a ring, in the texture and in space.
struct TexturedCorners {
  Vec2f uv[3];
  Vec3f position[3];
};

struct TexturedPoint {
  Vec3d point;
  double stretch;  ///< model units a unit of texture, at most
};

/// The point of a surface that has the texture coordinate `p`: in the triangle that holds it best.
[[nodiscard]] TexturedPoint textured_point(const std::vector<TexturedCorners>& surface, const Vec2d& p);

/// A texture coordinate in one of the triangles.
[[nodiscard]] Vec2d random_point_of(Rng& rng, const std::vector<TexturedCorners>& surface);

}  // namespace etalon::test
