// Texels of half-square triangles as SVG: on the map, or laid on any triangle of the plane.
#pragma once

#include <string>

#include "core/bake/atlas.h"

namespace etalon::validation {

/// Colours that colour-blind readers can tell apart [Okabe & Ito 2008], repeated.
[[nodiscard]] const char* drawing_hue(std::size_t n);

/// Where the texture triangle's plane, with corners (0, 0), (size, 0) and (0, size), comes to lie in a drawing.
class TexelCanvas {
 public:
  /// The three places of these corners, in the drawing.
  TexelCanvas(int size, const Vec2d& right, const Vec2d& along_i, const Vec2d& along_j)
      : size_(size), right_(right), i_((along_i - right) * (1.0 / size)), j_((along_j - right) * (1.0 / size)) {}
  /// On the map: `origin` is where the map's lower left corner is drawn, `scale` a texel's side; rows go up.
  TexelCanvas(const bake::Tile& tile, const Vec2d& origin, double scale);

  [[nodiscard]] Vec2d at(double i, double j) const { return right_ + i_ * i + j_ * j; }
  [[nodiscard]] Vec2d center(int i, int j) const { return at(i + 0.5, j + 0.5); }
  /// Texel (i, j), whole or, `cut`, what of it is inside the triangle.
  [[nodiscard]] std::string texel(int i, int j, const std::string& attributes, bool cut = false) const;
  [[nodiscard]] std::string outline(const std::string& attributes) const;

 private:
  int size_;
  Vec2d right_, i_, j_;
};

}  // namespace etalon::validation
