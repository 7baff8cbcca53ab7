#include "validation/studies/texel_canvas.h"

#include <fmt/format.h>

#include "validation/studies/svg.h"

namespace etalon::validation {
namespace {

Vec2d on_drawing(const bake::Tile& tile, int slot, const Vec2d& origin, double scale) {
  const Vec2d p = bake::corner_place(tile, (tile.right_corner + slot) % 3, 0);
  return {origin.x + scale * p.x, origin.y - scale * p.y};
}

}  // namespace

const char* drawing_hue(std::size_t n) {
  constexpr const char* kHues[] = {"#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#8a8f98"};
  return kHues[n % 8];
}

TexelCanvas::TexelCanvas(const bake::Tile& tile, const Vec2d& origin, double scale)
    : TexelCanvas(tile.size, on_drawing(tile, 0, origin, scale), on_drawing(tile, 1, origin, scale), on_drawing(tile, 2, origin, scale)) {}

std::string TexelCanvas::texel(int i, int j, const std::string& attributes, bool cut) const {
  const Vec2d a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
  if (cut && i + j + 1 == size_) return svg_triangle(a, b, d, attributes);
  return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}Z\" {}/>", a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y,
                     attributes);
}

std::string TexelCanvas::outline(const std::string& attributes) const {
  return svg_triangle(at(0, 0), at(size_, 0), at(0, size_), attributes);
}

}  // namespace etalon::validation
