// The few SVG elements that the drawings of studies are made of; colours and fonts are study.css's (axis, grid, faint).
#pragma once

#include <string>

#include "core/math/vec.h"

namespace etalon::validation {

[[nodiscard]] std::string svg_open(int width, int height, const std::string& label);
[[nodiscard]] std::string svg_text(double x, double y, const std::string& words, const char* anchor = "start", const char* css = "");
[[nodiscard]] std::string svg_line(const Vec2d& a, const Vec2d& b, const std::string& attributes);
[[nodiscard]] std::string svg_dot(const Vec2d& at, double radius, const std::string& attributes);
[[nodiscard]] std::string svg_triangle(const Vec2d& a, const Vec2d& b, const Vec2d& c, const std::string& attributes);

}  // namespace etalon::validation
