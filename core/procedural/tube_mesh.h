// A closed genus-0 mesh wrapped around an implicit surface that is symmetric in x: rings of vertices around a spine, from a front pole to
// a back pole, each ring with as many vertices as its length asks for, so that triangles come out nearly equilateral.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/procedural/implicit.h"

namespace etalon::procedural {

/// A cone of rays around the spine. A ray at angle φ (0 ventral, ½ turn dorsal, +x between) has the direction
/// cos·(−dorsal·cos φ + X·sin φ) + sin·forward, with (cos, sin) = (cone_cos, cone_sin).
struct SpinePose {
  Vec3d center;
  Vec3d dorsal;   ///< unit, in the plane x = 0
  Vec3d forward;  ///< unit, in the plane x = 0, perpendicular to dorsal
  double cone_cos = 1;
  double cone_sin = 0;
};

struct TubeOptions {
  std::uint32_t faces = 7684;              ///< wanted; the result has the next even vertex count below (faces + 4)/2, at least 38
  Field field = nullptr;                   ///< the surface; each ray's outermost zero is taken
  Field density = nullptr;                 ///< relative number of vertices per length, > 0
  SpinePose (*spine)(double t) = nullptr;  ///< t = 0: front pole (cone_sin = 1), t = 1: back pole (cone_sin = −1)
  double reach = 4;                        ///< rays start at this distance
  int relaxation_steps = 12;
};

/// Rings are numbered from the front: ring 0 is the front pole and the last ring the back pole (1 vertex each), every other ring r has
/// 2·half_counts[r] vertices from the ventral line over +x to the dorsal line and back over −x.
struct TubeMesh {
  std::vector<Vec3d> positions;
  std::vector<std::uint32_t> ring_starts;  ///< #rings: first vertex
  std::vector<std::uint32_t> half_counts;  ///< #rings: 0 for the poles
  /// A face's corner: ring and place on it; place 2·half_count is place 0 reached from the other side (another wedge of the same vertex).
  struct Corner {
    std::uint32_t ring;
    std::uint32_t place;
  };
  std::vector<std::array<Corner, 3>> faces;  ///< counter-clockwise from outside; from front to back

  [[nodiscard]] std::uint32_t vertex(Corner c) const {
    const std::uint32_t count = 2 * half_counts[c.ring];
    return ring_starts[c.ring] + (count == 0 ? 0 : c.place % count);
  }
};

/// Mirror-symmetric to the last bit; deterministic for any thread count.
[[nodiscard]] TubeMesh wrap_tube(const TubeOptions& options);

}  // namespace etalon::procedural
