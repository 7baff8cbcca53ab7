// Triangles of an implicit surface by marching tetrahedra on a body-centred cubic lattice: closed and manifold for every field that is
// positive outside a box, whatever its gradient. No tables of ambiguous cubes, since a tetrahedron has none.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/procedural/implicit.h"

namespace etalon::procedural {

/// Positions on the surface and counter-clockwise triangles seen from outside (where the field is positive).
struct IsoTriangles {
  std::vector<Vec3d> positions;
  std::vector<std::array<std::uint32_t, 3>> faces;
};

struct IsoLattice {
  Field field = nullptr;
  Vec3d lo{0, 0, 0}, hi{0, 0, 0};  ///< the surface lies strictly inside this box
  Vec3d seed{0, 0, 0};             ///< a point inside; the component first met from it toward +x is the one that is followed
  double spacing = 0.1;            ///< side of a lattice cube; about 6.46/spacing² vertices a unit of area
};

/// Only blocks of cubes that the surface passes are visited: time and memory go with the area. Vertices lie on lattice edges where the field is
/// 0 to first order (three safeguarded steps of regula falsi), ordered by lattice point; faces follow their lattice cube. Equal bytes for any
/// thread count. InputError where the box is empty, holds more than 50,000 cubes a side or 2^31 blocks, is left by the surface, or no
/// surface is met.
[[nodiscard]] IsoTriangles march_lattice(const IsoLattice& lattice);

}  // namespace etalon::procedural
