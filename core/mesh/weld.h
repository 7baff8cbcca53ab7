// Makes a mesh out of what files store: one vertex per place in space, one wedge per vertex and texture coordinate.
#pragma once

#include "core/mesh/mesh.h"

namespace etalon {

/// Merges vertices of equal position and equal colour, then wedges of equal vertex and equal uv (of equal vertex alone where the mesh has
/// no uv). Equality is of numbers (−0 equals 0), and of bits for a NaN. Survivors keep the order, and the values, of their first
/// appearance; faces keep their order; unreferenced vertices stay. InputError where an index is out of range.
[[nodiscard]] Mesh welded_by_position(const Mesh& mesh);

}  // namespace etalon
