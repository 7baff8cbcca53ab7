// A mesh with vertex colours from double positions: what the models for simplification are made of.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/mesh/mesh.h"

namespace etalon::procedural {

/// Positions rounded to float32, wedge i is vertex i, no texture coordinates; colours from `paint` (called once a vertex, from several
/// threads), each channel brought into [0, 1] and rounded to one of 256 steps, as a scanner stores it.
[[nodiscard]] Mesh colored_mesh(const std::vector<Vec3d>& positions, const std::vector<std::array<std::uint32_t, 3>>& faces,
                                const std::function<Vec3d(const Vec3d& p)>& paint);

}  // namespace etalon::procedural
