// Positions in a cube of about unit side: nothing computed from them leaves the range of float32 or double.
#pragma once

#include <vector>

#include "core/math/nearest_point.h"
#include "core/simplify/collapse_mesh.h"

namespace etalon::simplify {

/// Positions by engine vertex, times the power of two that brings the longest side of their box into (0.5, 1]; so scaling rounds nothing
/// (coordinates below 2^-126 apart). A mesh of one point has scale 1.
struct UnitPositions {
  std::vector<Vec3f> at;
  double unit = 1;     ///< model length of a scaled length of 1: a power of two
  double longest = 1;  ///< scaled length of the box's longest side; 1 for a mesh of one point
};

/// A place of the unit cube in model units: exact, but for what a float32 cannot hold.
[[nodiscard]] inline Vec3f model_place(const UnitPositions& positions, const Vec3f& at) {
  return {static_cast<float>(at.x * positions.unit), static_cast<float>(at.y * positions.unit), static_cast<float>(at.z * positions.unit)};
}

[[nodiscard]] UnitPositions unit_positions(const CollapseMesh& mesh);

}  // namespace etalon::simplify
