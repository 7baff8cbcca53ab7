#include "validation/studies/svg.h"

#include <fmt/format.h>

#include "validation/report/html_text.h"

namespace etalon::validation {

std::string svg_open(int width, int height, const std::string& label) {
  return fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\" xmlns=\"http://www.w3.org/2000/svg\">", width, height,
                     escaped(label));
}

std::string svg_text(double x, double y, const std::string& words, const char* anchor, const char* css) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" class=\"{}\">{}</text>", x, y, anchor, css, escaped(words));
}

std::string svg_line(const Vec2d& a, const Vec2d& b, const std::string& attributes) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>", a.x, a.y, b.x, b.y, attributes);
}

std::string svg_dot(const Vec2d& at, double radius, const std::string& attributes) {
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}/>", at.x, at.y, radius, attributes);
}

std::string svg_triangle(const Vec2d& a, const Vec2d& b, const Vec2d& c, const std::string& attributes) {
  return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}Z\" {}/>", a.x, a.y, b.x, b.y, c.x, c.y, attributes);
}

}  // namespace etalon::validation
