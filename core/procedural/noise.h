// Noise from an integer hash: no tables, no state, equal on every platform.
#pragma once

#include <cstdint>

#include "core/math/vec.h"

namespace etalon::procedural {

/// 64 well mixed bits of a lattice point (SplitMix64's finaliser over an odd-weighted sum of coordinates and seed).
[[nodiscard]] std::uint64_t lattice_hash(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed);

/// Value noise in [-1, 1]: hashed lattice values blended by the quintic fade 6t⁵ − 15t⁴ + 10t³; lattice spacing 1. |p| < 2^31.
[[nodiscard]] double value_noise(const Vec3d& p, std::uint64_t seed);

/// Sum of `octaves` value noises, each of half the amplitude and double the frequency; in (-2, 2), mostly within ±1.
[[nodiscard]] double fractal_noise(const Vec3d& p, int octaves, std::uint64_t seed);

/// The two nearest of the jittered points, one in each unit cell (searched in the 27 cells around p, which is what defines it).
struct Cells {
  double nearest;          ///< distance to the nearest point
  double second;           ///< distance to the next one
  Vec3d gradient;          ///< of second − nearest; points away from the border between the two
  std::uint64_t identity;  ///< hash of the cell that owns the nearest point
};
[[nodiscard]] Cells cellular_noise(const Vec3d& p, std::uint64_t seed);

}  // namespace etalon::procedural
