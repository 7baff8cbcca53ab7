#include "core/procedural/alps_paint.h"

#include <cmath>

#include "core/procedural/noise.h"
#include "core/procedural/smooth_math.h"

namespace etalon::procedural {

namespace {

// Noise over `metres`, of a seed of its own.
class PlaceNoise {
 public:
  PlaceNoise(double x, double y, std::uint64_t seed) : x_m_(x * kReliefSpacing_m), y_m_(y * kReliefSpacing_m), seed_(seed) {}
  [[nodiscard]] double operator()(double metres, int octaves, std::uint64_t kind) const {
    return fractal_noise(Vec3d(x_m_ / metres, y_m_ / metres, 0.43), octaves, seed_ + 1000 + kind);
  }

 private:
  double x_m_, y_m_;
  std::uint64_t seed_;
};

struct Place {
  double height_m, slope, flow, river_m;
  PlaceNoise noise;
};

Vec3d rock(const Place& p) {
  const double strata = clamp01(0.5 + 0.16 * sin_turns(p.height_m / 61 + 1.7 * p.noise(210, 4, 1)) + 0.5 * p.noise(95, 4, 19));
  const Vec3d grey = mix(Vec3d(0.44, 0.42, 0.40), Vec3d(0.66, 0.64, 0.61), strata);
  return grey * (1 + 0.28 * p.noise(26, 4, 2)) * (1 + 0.14 * p.noise(10, 2, 24));
}

Vec3d meadow(const Place& p) {
  const Vec3d green = mix(Vec3d(0.36, 0.45, 0.21), Vec3d(0.52, 0.52, 0.30), clamp01(0.5 + 0.6 * p.noise(220, 4, 3)));
  return green * (1 + 0.13 * p.noise(18, 3, 4));
}

// Crowns with their shadows, a few metres wide.
Vec3d forest(const Place& p) {
  const double crown = p.noise(9, 2, 5);
  return mix(Vec3d(0.10, 0.18, 0.10), Vec3d(0.24, 0.33, 0.17), clamp01(0.45 + 0.7 * crown)) * (1 + 0.12 * p.noise(120, 2, 6));
}

// Fields of the valley floor, each of its own green or gold, some mown in stripes.
Vec3d field(const Place& p, double x, double y) {
  const double metres = kReliefSpacing_m, size = 110;
  const double turned_x = (0.8 * x - 0.6 * y) * metres / size, turned_y = (0.6 * x + 0.8 * y) * metres / (0.55 * size);
  const Cells cells = cellular_noise(Vec3d(turned_x, turned_y, 0.5), 4242);
  const double kind = static_cast<double>(cells.identity >> 11) * 0x1p-53;
  Vec3d color = mix(Vec3d(0.33, 0.47, 0.19), Vec3d(0.60, 0.59, 0.31), kind * kind);
  if (kind > 0.6 && kind < 0.8) color = color * (1 + 0.08 * sin_turns(turned_x * size / 12));
  const double edge = (cells.second - cells.nearest) * 0.55 * size;
  color = mix(Vec3d(0.21, 0.29, 0.13), color, smooth_step(2, 5, edge));
  return color * (1 + 0.06 * p.noise(12, 2, 7));
}

Vec3d snow(const Place& p) { return Vec3d(0.93, 0.94, 0.97) * (1 + 0.03 * p.noise(40, 3, 8)); }

// Houses along the road: roofs of a few colours on a grid of 16 m.
bool house(const Place& p, double x, double y, Vec3d& color) {
  const double metres = kReliefSpacing_m, cell_m = 16;
  const double u = (0.8 * x + 0.6 * y) * metres / cell_m, v = (0.8 * y - 0.6 * x) * metres / cell_m;
  const double iu = std::floor(u), iv = std::floor(v);
  const std::uint64_t hash = lattice_hash(static_cast<std::int64_t>(iu), static_cast<std::int64_t>(iv), 0, 99);
  const double village = p.noise(500, 2, 9);
  if (p.slope > 0.2 || village < 0.25 || p.river_m < 45 || p.river_m > 190 || hash % 5 > 1) return false;
  if (std::fabs(u - iu - 0.5) > 0.36 || std::fabs(v - iv - 0.5) > 0.28) return false;
  const Vec3d roof = hash % 3 == 0 ? Vec3d(0.55, 0.30, 0.22) : (hash % 3 == 1 ? Vec3d(0.42, 0.39, 0.37) : Vec3d(0.36, 0.25, 0.19));
  color = roof * (v - iv > 0.5 ? 1.15 : 0.8);
  return true;
}

// Dry land without sun and shade.
Vec3d land(const Place& p, double x, double y) {
  Vec3d color = meadow(p);
  const double floor = smooth_step(0.16, 0.09, p.slope) * smooth_step(230, 180, p.river_m + 40 * p.noise(90, 2, 10));
  color = mix(color, field(p, x, y), floor);
  const double trees = p.noise(300, 5, 11) + 0.35 * p.noise(45, 3, 12);
  const double tree_line = smooth_step(2010, 1860, p.height_m + 120 * p.noise(260, 3, 13));
  const double woods = smooth_step(-0.12, 0.02, trees) * tree_line * (1 - floor) * smooth_step(1.35, 1.05, p.slope);
  color = mix(color, forest(p), woods);
  const double scree = smooth_step(0.45, 0.7, p.slope + 0.2 * p.noise(70, 4, 14)) * smooth_step(1800, 2050, p.height_m);
  color = mix(color, Vec3d(0.66, 0.64, 0.60) * (1 + 0.2 * p.noise(8, 2, 15)), 0.8 * scree * (1 - woods));
  const double bare =
      smooth_step(0.95, 1.2, p.slope + 0.3 * p.noise(60, 4, 16)) + smooth_step(2080, 2280, p.height_m + 170 * p.noise(180, 4, 17));
  color = mix(color, rock(p), clamp01(bare) * (1 - 0.6 * woods));
  const double white = smooth_step(2120, 2170, p.height_m + 130 * p.noise(240, 5, 18) - 150 * p.slope);
  return mix(color, snow(p), white);
}

}  // namespace

Vec3d alps_color(const AlpsGround& ground, double x, double y, double texel, std::uint64_t seed) {
  const double step = std::fmax(0.25, texel);
  const Vec2d gradient = ground.gradient(x, y, step);
  Place p{ground.height_m(x, y), std::sqrt(gradient.x * gradient.x + gradient.y * gradient.y), ground.flow(x, y),
          ground.river_distance_m(x, y), PlaceNoise(x, y, seed)};
  if (ground.lake(x, y) >= 0.5) {
    const double depth = smooth_step(0.5, 1, ground.lake(x, y));
    return mix(Vec3d(0.20, 0.42, 0.42), Vec3d(0.08, 0.22, 0.30), depth) * (1 + 0.03 * p.noise(70, 3, 20));
  }
  Vec3d color = land(p, x, y);
  // Streams over gravel, wider with what they carry; the main river; a road beside it, never quite straight.
  const double bed = std::sqrt(p.flow) * 0.07 * smooth_step(80, 500, p.flow);
  color = mix(color, Vec3d(0.60, 0.59, 0.55), 0.6 * smooth_step(1.5, 2.2, bed));
  color = mix(color, Vec3d(0.25, 0.37, 0.38), smooth_step(7.5, 4.5, p.river_m + 2 * p.noise(30, 2, 21)));
  const double road_m = std::fabs(p.river_m - 62 - 26 * p.noise(420, 2, 22));
  color = mix(color, Vec3d(0.70, 0.69, 0.67), smooth_step(5.5, 3.0, road_m) * smooth_step(0.5, 0.3, p.slope));
  const double track_m = std::fabs(p.noise(900, 2, 23)) * 900;
  color = mix(color, Vec3d(0.64, 0.60, 0.50),
              0.8 * smooth_step(4, 2, track_m) * smooth_step(0.55, 0.4, p.slope) * smooth_step(2300, 2200, p.height_m));
  Vec3d roof;
  if (house(p, x, y, roof)) color = roof;
  // The sun stands in the south-east, 50 degrees high.
  const double normal = 1 / std::sqrt(1 + p.slope * p.slope);
  const double sun = (-gradient.x * 0.40 + gradient.y * 0.50 + 0.77) * normal;
  const double light = 0.38 + 0.80 * clamp01(sun);
  return color * Vec3d(light, light, light * 0.94 + 0.06);
}

}  // namespace etalon::procedural
