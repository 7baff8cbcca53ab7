// The alps between grid points: height, slope, water and lake at any place.
#pragma once

#include "core/procedural/alps_erosion.h"

namespace etalon::procedural {

/// Places are in cells of the relief's inner square: (0, 0) to (256, 256), and a little beyond; x east, y north.
class AlpsGround {
 public:
  AlpsGround(Relief relief, std::uint64_t seed);

  /// Metres above the sea: Catmull-Rom between cells, and rock's roughness, more of it where it is steep. The lake is level.
  [[nodiscard]] double height_m(double x, double y) const;
  /// (∂h/∂east, ∂h/∂north), from heights `step` cells apart.
  [[nodiscard]] Vec2d gradient(double x, double y, double step) const;
  /// In the lake from ½ on.
  [[nodiscard]] double lake(double x, double y) const { return bilinear(relief_.lake, x, y); }
  [[nodiscard]] double flow(double x, double y) const { return bilinear(relief_.flow, x, y); }
  /// To the main river, its cells joined by lines.
  [[nodiscard]] double river_distance_m(double x, double y) const;

 private:
  [[nodiscard]] double at(const std::vector<double>& values, int x, int y) const;
  [[nodiscard]] double bilinear(const std::vector<double>& values, double x, double y) const;
  [[nodiscard]] double cubic(double x, double y) const;

  Relief relief_;
  std::uint64_t seed_;
};

}  // namespace etalon::procedural
