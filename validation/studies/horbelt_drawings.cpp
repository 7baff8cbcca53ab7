#include "validation/studies/horbelt_drawings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/studies/svg.h"

namespace etalon::validation {
namespace {

constexpr double kLeft = 70, kTop = 20, kWidth = 860, kHeight = 480;

// A linear scale from data to pixels.
struct Axis {
  double low, high, from, to;
  [[nodiscard]] double at(double value) const { return from + (value - low) / (high - low) * (to - from); }
};

struct Range {
  double low = 1e300, high = -1e300;
  void add(double v) { low = std::min(low, v), high = std::max(high, v); }
};

// Steps of 1, 2 or 5 times a power of ten, at most `most` of them.
double tick_step(double span, int most) {
  double step = 1e-3;
  for (;;) {
    for (const double factor : {1.0, 2.0, 5.0})
      if (span / (step * factor) <= most) return step * factor;
    step *= 10;
  }
}

std::string path_element(const std::vector<Vec2d>& points, const char* attributes) {
  std::string d;
  for (const Vec2d& p : points) d += fmt::format("{}{:.1f} {:.1f}", d.empty() ? "M" : "L", p.x, p.y);
  return fmt::format("<path d=\"{}\" fill=\"none\" {}/>", d, attributes);
}

std::string frame(const char* across, const char* up) {
  return fmt::format("<path d=\"M{0} {1}V{2}H{3}\" fill=\"none\" class=\"axis\"/>", kLeft, kTop, kTop + kHeight, kLeft + kWidth) +
         svg_text(kLeft + kWidth / 2, kTop + kHeight + 42, across, "middle") +
         fmt::format("<text transform=\"translate(18 {:.0f}) rotate(-90)\" text-anchor=\"middle\">{}</text>", kTop + kHeight / 2, up);
}

constexpr const char* kThin = "stroke=\"#4b7bd1\" stroke-width=\"0.9\" opacity=\"0.75\"";
constexpr const char* kBold = "stroke=\"#d0312d\" stroke-width=\"3\" stroke-linejoin=\"round\"";
constexpr const char* kFound = "stroke=\"#1746a2\" stroke-width=\"1.6\" stroke-linejoin=\"round\"";

// From violet over green to yellow: a sequence whose lightness rises.
std::string level_color(double t) {
  struct Stop {
    double r, g, b;
  };
  constexpr Stop kStops[] = {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {223, 205, 36}};
  const double at = std::clamp(t, 0.0, 1.0) * 4;
  const int n = std::min(static_cast<int>(at), 3);
  const double f = at - n;
  const auto mix = [&](double a, double b) { return static_cast<int>(a + (b - a) * f + 0.5); };
  return fmt::format("rgb({},{},{})", mix(kStops[n].r, kStops[n + 1].r), mix(kStops[n].g, kStops[n + 1].g),
                     mix(kStops[n].b, kStops[n + 1].b));
}

// Marching squares over one cell of pairs: where the line of `level` crosses its sides.
void contour_cell(const std::array<double, 4>& corners, const std::array<Vec2d, 4>& places, double level, std::string& d) {
  std::vector<Vec2d> crossings;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t n = (k + 1) % 4;
    if ((corners[k] < level) == (corners[n] < level)) continue;
    const double t = (level - corners[k]) / (corners[n] - corners[k]);
    crossings.push_back({places[k].x + (places[n].x - places[k].x) * t, places[k].y + (places[n].y - places[k].y) * t});
  }
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
    d += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", crossings[k].x, crossings[k].y, crossings[k + 1].x, crossings[k + 1].y);
}

double shown_db(const HorbeltViewResult& view, joint::Pair pair) { return view.psnr_db(pair).value_or(99.0); }

}  // namespace

std::string rate_drawing(const HorbeltViewResult& view) {
  const std::size_t meshes = view.all.mesh_count, textures = view.all.texture_count;
  Range db;
  for (std::size_t i = 0; i < meshes; ++i)
    for (std::size_t j = 0; j < textures; ++j) db.add(shown_db(view, {i, j}));
  const double most_kbit = static_cast<double>(view.mesh_bits.back() + view.texture_bits.back()) / 1000;
  const Axis x{0, most_kbit, kLeft, kLeft + kWidth}, y{std::floor(db.low), std::ceil(db.high), kTop + kHeight, kTop};
  const auto place = [&](std::uint64_t bits, double value) { return Vec2d(x.at(static_cast<double>(bits) / 1000), y.at(value)); };

  std::string svg = svg_open(1000, 560, "PSNR over bits: every texture with all meshes, and the best of all pairs");
  for (double at = y.low; at <= y.high + 1e-9; at += tick_step(y.high - y.low, 10))
    svg += svg_line({kLeft, y.at(at)}, {kLeft + kWidth, y.at(at)}, "class=\"grid\"") +
           svg_text(kLeft - 8, y.at(at) + 4, fmt::format("{:g}", at), "end", "faint");
  for (double at = 0; at <= x.high; at += tick_step(x.high, 10))
    svg += svg_text(x.at(at), kTop + kHeight + 20, fmt::format("{:g}", at), "middle", "faint");
  for (std::size_t j = 0; j < textures; ++j) {
    std::vector<Vec2d> line;
    for (std::size_t i = 0; i < meshes; ++i) line.push_back(place(view.mesh_bits[i] + view.texture_bits[j], shown_db(view, {i, j})));
    svg += path_element(line, kThin);
    if ((j % 5 == 0 && j + 3 < textures) || j + 1 == textures)
      svg += svg_text(line.back().x + 4, line.back().y + 4, fmt::format("T{}", j), line.back().x > kLeft + kWidth - 30 ? "end" : "start",
                      "faint");
  }
  std::vector<Vec2d> stairs;
  for (const joint::Staircase::Stair& s : view.stairs) {
    const Vec2d at = place(s.bits, shown_db(view, s.pair));
    if (!stairs.empty()) stairs.push_back({at.x, stairs.back().y});
    stairs.push_back(at);
  }
  svg += path_element(stairs, kBold);
  std::vector<Vec2d> found;
  for (const joint::PathPoint& p : view.of(HorbeltMethod::slope).path.points) found.push_back(place(p.bits, shown_db(view, p.pair)));
  svg += path_element(found, kFound);
  return svg + frame("kilobits of mesh and texture", "PSNR, dB") + "</svg>";
}

std::string iso_drawing(const HorbeltViewResult& view) {
  const std::size_t meshes = view.all.mesh_count, textures = view.all.texture_count;
  const Axis x{0, static_cast<double>(meshes - 1), kLeft, kLeft + kWidth - 60},
      y{0, static_cast<double>(textures - 1), kTop + kHeight, kTop};
  const auto place = [&](joint::Pair p) { return Vec2d(x.at(static_cast<double>(p.mesh)), y.at(static_cast<double>(p.texture))); };
  Range db;
  for (std::size_t i = 0; i < meshes; ++i)
    for (std::size_t j = 0; j < textures; ++j) db.add(shown_db(view, {i, j}));

  std::string svg = svg_open(1000, 560, "lines of equal PSNR over mesh and texture levels, the best pairs and those found");
  const double step = tick_step(db.high - db.low, 16);
  int shown = 0;
  for (double level = std::ceil(db.low / step) * step; level < db.high; level += step, ++shown) {
    std::string d;
    for (std::size_t i = 0; i + 1 < meshes; ++i)
      for (std::size_t j = 0; j + 1 < textures; ++j) {
        const std::array<joint::Pair, 4> pairs = {joint::Pair{i, j}, joint::Pair{i + 1, j}, joint::Pair{i + 1, j + 1},
                                                  joint::Pair{i, j + 1}};
        std::array<double, 4> corners;
        std::array<Vec2d, 4> places;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = shown_db(view, pairs[k]), places[k] = place(pairs[k]);
        contour_cell(corners, places, level, d);
      }
    const std::string color = level_color((level - db.low) / (db.high - db.low));
    svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>", d, color);
    const double key_y = kTop + kHeight - 20.0 * shown;
    svg += fmt::format("<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"16\" height=\"14\" fill=\"{}\"/>", kLeft + kWidth - 30, key_y - 14, color) +
           svg_text(kLeft + kWidth - 8, key_y - 2, fmt::format("{:g} dB", level));
  }
  std::vector<Vec2d> best, found;
  for (const joint::Staircase::Stair& s : view.stairs) best.push_back(place(s.pair));
  for (const joint::PathPoint& p : view.of(HorbeltMethod::slope).path.points) found.push_back(place(p.pair));
  svg += path_element(best, kBold) + path_element(found, kFound);
  for (std::size_t i = 0; i < meshes; i += std::max<std::size_t>(1, meshes / 6))
    svg += svg_text(x.at(static_cast<double>(i)), kTop + kHeight + 20, fmt::format("{:.1f}", static_cast<double>(view.mesh_bits[i]) / 1000),
                    "middle", "faint");
  for (std::size_t j = 0; j < textures; j += std::max<std::size_t>(1, textures / 6))
    svg += svg_text(kLeft - 8, y.at(static_cast<double>(j)) + 4, fmt::format("{:.1f}", static_cast<double>(view.texture_bits[j]) / 1000),
                    "end", "faint");
  return svg + frame("mesh, kilobits (a level a step)", "texture, kilobits") + "</svg>";
}

}  // namespace etalon::validation
