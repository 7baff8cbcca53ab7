#include "core/procedural/alps_ground.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/procedural/noise.h"
#include "core/procedural/smooth_math.h"

namespace etalon::procedural {

namespace {

constexpr double kValley_m = 1430;

double catmull_rom(const std::array<double, 4>& p, double t) {
  return p[1] + 0.5 * t * (p[2] - p[0] + t * (2 * p[0] - 5 * p[1] + 4 * p[2] - p[3] + t * (3 * (p[1] - p[2]) + p[3] - p[0])));
}

}  // namespace

AlpsGround::AlpsGround(Relief relief, std::uint64_t seed) : relief_(std::move(relief)), seed_(seed) {}

double AlpsGround::at(const std::vector<double>& values, int x, int y) const {
  const int column = std::clamp(x + kReliefMargin, 0, kReliefSize - 1), row = std::clamp(y + kReliefMargin, 0, kReliefSize - 1);
  return values[static_cast<std::size_t>(row * kReliefSize + column)];
}

double AlpsGround::bilinear(const std::vector<double>& values, double x, double y) const {
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double s = x - i, t = y - j;
  return mix(mix(at(values, i, j), at(values, i + 1, j), s), mix(at(values, i, j + 1), at(values, i + 1, j + 1), s), t);
}

double AlpsGround::cubic(double x, double y) const {
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  std::array<double, 4> rows{};
  for (int r = 0; r < 4; ++r) {
    std::array<double, 4> p{};
    for (int c = 0; c < 4; ++c) p[static_cast<std::size_t>(c)] = at(relief_.height_m, i - 1 + c, j - 1 + r);
    rows[static_cast<std::size_t>(r)] = catmull_rom(p, x - i);
  }
  return catmull_rom(rows, y - j);
}

double AlpsGround::height_m(double x, double y) const {
  if (lake(x, y) >= 0.5) return kValley_m + relief_.lake_level_m;
  const double dx = bilinear(relief_.height_m, x + 1, y) - bilinear(relief_.height_m, x - 1, y);
  const double dy = bilinear(relief_.height_m, x, y + 1) - bilinear(relief_.height_m, x, y - 1);
  const double slope = std::sqrt(dx * dx + dy * dy) / (2 * kReliefSpacing_m);
  const double rough = smooth_step(0.15, 0.9, slope);
  // Folds of the rock, seven octaves from 160 m down to 2.5 m.
  const double fold = 1 - std::fabs(fractal_noise(Vec3d(x / 8, y / 8, 0.31), 7, seed_ + 21));
  const double height = kValley_m + cubic(x, y) + 17 * rough * (fold - 0.6);
  return std::max(height, kValley_m + relief_.lake_level_m * (lake(x, y) > 0 ? 1 : 0));
}

Vec2d AlpsGround::gradient(double x, double y, double step) const {
  const double run = 2 * step * kReliefSpacing_m;
  return {(height_m(x + step, y) - height_m(x - step, y)) / run, (height_m(x, y + step) - height_m(x, y - step)) / run};
}

double AlpsGround::river_distance_m(double x, double y) const {
  double least = 1e12;
  for (std::size_t n = 0; n + 1 < relief_.river.size(); ++n) {
    const Vec2d a = relief_.river[n], b = relief_.river[n + 1];
    const double ex = b.x - a.x, ey = b.y - a.y, px = x - a.x, py = y - a.y;
    const double t = clamp01((px * ex + py * ey) / (ex * ex + ey * ey));
    const double dx = px - t * ex, dy = py - t * ey;
    least = std::min(least, dx * dx + dy * dy);
  }
  return std::sqrt(least) * kReliefSpacing_m;
}

}  // namespace etalon::procedural
