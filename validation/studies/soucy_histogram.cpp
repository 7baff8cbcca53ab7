// Figures 9b and 10b: how often which error.
#include <fmt/format.h>

#include <algorithm>

#include "validation/metrics/decibel.h"
#include "validation/report/json_report.h"
#include "validation/studies/soucy_drawings.h"
#include "validation/studies/svg.h"

namespace etalon::validation {
namespace {

/// Bars of a histogram in a box; heights are decades: from one texel, a short bar, up.
std::string bars(const SoucyError& error, double x, double y, double width, double height) {
  constexpr double kDecades = 5.3;  // a frame of 65,536 texels of three channels has fewer than 2·10^5
  std::string svg;
  for (int decade = 0; decade <= 5; ++decade) {
    const double line = y + height - height * (decade + 0.3) / kDecades;
    svg += svg_line({x, line}, {x + width, line}, "class=\"grid\"");
  }
  std::string path;
  for (std::size_t n = 0; n < error.histogram.size(); ++n) {
    if (error.histogram[n] == 0) continue;
    const double tall = height * std::min(1.0, (decibel(static_cast<double>(error.histogram[n])) / 10 + 0.3) / kDecades);
    path += fmt::format("M{:.2f} {:.1f}V{:.1f}", x + width * (static_cast<double>(n) + 0.5) / 511, y + height, y + height - tall);
  }
  return svg + fmt::format("<path d=\"{}\" stroke=\"#0072b2\" stroke-width=\"{:.2f}\"/>", path, std::max(0.8, width / 511)) +
         svg_line({x, y + height}, {x + width, y + height}, "class=\"axis\"");
}

}  // namespace

std::string histogram_drawing(const SoucyError& error, const std::string& label) {
  std::string svg = svg_open(760, 330, label);
  constexpr double kX = 90, kY = 20, kWidth = 640, kHeight = 240;
  svg += bars(error, kX, kY, kWidth, kHeight);
  for (const int at : {-255, -128, 0, 128, 255})
    svg += svg_text(kX + kWidth * (at + 255.5) / 511, kY + kHeight + 20, fmt::format("{}{}", at < 0 ? "−" : "", std::abs(at)), "middle",
                    "faint");
  std::uint64_t decade = 1;
  for (int n = 0; n <= 5; ++n, decade *= 10)
    svg += svg_text(kX - 8, kY + kHeight - kHeight * (n + 0.3) / 5.3 + 4, grouped(decade), "end", "faint");
  return svg + svg_text(kX + kWidth / 2, kY + kHeight + 42, "texture minus pattern; pixels by decades", "middle", "faint") + "</svg>";
}

std::string histograms_drawing(const std::vector<NamedError>& errors, int columns, const std::string& label) {
  const int rows = (static_cast<int>(errors.size()) + columns - 1) / columns;
  constexpr double kWidth = 1000, kRow = 138;
  std::string svg = svg_open(static_cast<int>(kWidth), static_cast<int>(kRow * rows), label);
  for (std::size_t n = 0; n < errors.size(); ++n) {
    const double cell = kWidth / columns, x = cell * static_cast<double>(n % static_cast<std::size_t>(columns)) + 8,
                 y = kRow * static_cast<double>(n / static_cast<std::size_t>(columns)) + 24;
    svg += svg_text(x, y - 7, errors[n].name, "start", "faint") + bars(*errors[n].error, x, y, cell - 16, kRow - 36);
  }
  return svg + "</svg>";
}

}  // namespace etalon::validation
