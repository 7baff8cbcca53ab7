// The examples of [Chen & Chuang 2006, Figures 1 to 3]: a line of two edges and a planar polygon, where adaptation is exact.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "core/draw/renderer.h"
#include "core/mesh/mesh.h"

namespace etalon::validation {

/// Figure 1: edges AC and CB become AB. Texture coordinates 0, 0.3, 1.
struct ChenLineExample {
  Vec2d a{0, 0}, b{1, 0}, c{0.62, 0.5};  ///< places
  double c_before = 0.3;                 ///< C's coordinate in the texture of AC, CB
  double c_after = 0;                    ///< and in that of AB, as the cells have it
};
[[nodiscard]] ChenLineExample line_example();

/// Figures 2 and 3: a hexagon in a plane with two vertices inside, removed one by one. The texture is made so that the finest level shows
/// rings.
struct ChenPlaneExample {
  struct Level {
    Mesh mesh;
    std::shared_ptr<const Image> adapted;   ///< texture; of the finest level the original
    std::shared_ptr<const Image> analytic;  ///< indexing map
    /// Of the points of a grid: how far, as a share of the hexagon's width, what the exact chain shows is from where it should be.
    double farthest = 0;
  };
  std::array<Level, 3> levels;  ///< M², M¹, M⁰
  std::shared_ptr<const Image> texture;
  std::size_t damped = 0;  ///< collapses in which anything was moved less far than the paper has it
};
[[nodiscard]] ChenPlaneExample plane_example(Renderer& renderer, int texture_px);

}  // namespace etalon::validation
