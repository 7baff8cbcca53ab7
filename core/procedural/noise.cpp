#include "core/procedural/noise.h"

#include <cmath>

namespace etalon::procedural {

namespace {

std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  return z ^ (z >> 31);
}

double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

}  // namespace

std::uint64_t lattice_hash(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
  return mixed(static_cast<std::uint64_t>(x) * 0xD6E8FEB86659FD93ull + static_cast<std::uint64_t>(y) * 0xA0761D6478BD642Full +
               static_cast<std::uint64_t>(z) * 0xE7037ED1A0B428DBull + (seed + 1) * 0x9E3779B97F4A7C15ull);
}

double value_noise(const Vec3d& p, std::uint64_t seed) {
  const double fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const auto ix = static_cast<std::int64_t>(fx), iy = static_cast<std::int64_t>(fy), iz = static_cast<std::int64_t>(fz);
  const double tx = fade(p.x - fx), ty = fade(p.y - fy), tz = fade(p.z - fz);
  double plane[2];
  for (int k = 0; k < 2; ++k) {
    double row[2];
    for (int j = 0; j < 2; ++j) {
      const double a = unit(lattice_hash(ix, iy + j, iz + k, seed));
      const double b = unit(lattice_hash(ix + 1, iy + j, iz + k, seed));
      row[j] = a + (b - a) * tx;
    }
    plane[k] = row[0] + (row[1] - row[0]) * ty;
  }
  return 2 * (plane[0] + (plane[1] - plane[0]) * tz) - 1;
}

double fractal_noise(const Vec3d& p, int octaves, std::uint64_t seed) {
  double sum = 0, amplitude = 1, frequency = 1;
  for (int i = 0; i < octaves; ++i) {
    sum += amplitude * value_noise(p * frequency, seed + static_cast<std::uint64_t>(i));
    amplitude *= 0.5;
    frequency *= 2;
  }
  return sum;
}

Cells cellular_noise(const Vec3d& p, std::uint64_t seed) {
  const double fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const auto ix = static_cast<std::int64_t>(fx), iy = static_cast<std::int64_t>(fy), iz = static_cast<std::int64_t>(fz);
  double nearest = 1e30, second = 1e30;  // squared until the end
  std::uint64_t identity = 0;
  Vec3d to_nearest(0, 0, 0), to_second(0, 0, 0);
  // Squared distance from p to the slab of cells at offset −1, 0, 1: cells farther than the second point need no look.
  const auto gap = [](double t, int offset) { return offset == 0 ? 0.0 : (offset < 0 ? t * t : (1 - t) * (1 - t)); };
  const double tx = p.x - fx, ty = p.y - fy, tz = p.z - fz;
  constexpr int kOrder[] = {0, -1, 1};
  for (const int k : kOrder)
    for (const int j : kOrder)
      for (const int i : kOrder) {
        if (gap(tx, i) + gap(ty, j) + gap(tz, k) > second) continue;
        const std::uint64_t h = lattice_hash(ix + i, iy + j, iz + k, seed);
        const double dx = fx + i + static_cast<double>(h & 0xFFFFF) * 0x1p-20 - p.x;
        const double dy = fy + j + static_cast<double>((h >> 20) & 0xFFFFF) * 0x1p-20 - p.y;
        const double dz = fz + k + static_cast<double>((h >> 40) & 0xFFFFF) * 0x1p-20 - p.z;
        const double d = dx * dx + dy * dy + dz * dz;
        if (d < nearest) {
          second = nearest;
          to_second = to_nearest;
          nearest = d;
          to_nearest = {dx, dy, dz};
          identity = h;
        } else if (d < second) {
          second = d;
          to_second = {dx, dy, dz};
        }
      }
  nearest = std::sqrt(nearest);
  second = std::sqrt(second);
  return {nearest, second, to_nearest * (1 / (nearest + 1e-9)) - to_second * (1 / (second + 1e-9)), identity};
}

}  // namespace etalon::procedural
