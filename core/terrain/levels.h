// Levels of detail of a height field: nested sets of points, their meshes, and how far these are from the field.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/terrain/height_field.h"
#include "core/terrain/removal_order.h"

namespace etalon::terrain {

inline constexpr std::size_t kMaxLevels = 4096;
inline constexpr std::uint16_t kNoLevel = 0xFFFF;

struct Levels {
  int bits = 0;
  std::vector<std::uint32_t> vertex_counts;  ///< of each level, corners included, ascending; level 0 is the coarsest
  std::vector<std::uint16_t> first_level;    ///< by grid point: the first level that has it; 0 for the corners, kNoLevel: in none
  [[nodiscard]] std::size_t count() const { return vertex_counts.size(); }
  friend bool operator==(const Levels&, const Levels&) = default;
};

/// `count` vertex counts in geometric progression from `from` to `to` (shares of (2^k+1)², 0 < from < to <= 1), rounded half to even, at least 4;
/// 60 from 0.001 to 0.1 are those of [Horbelt et al., sec. 4]. Equal neighbours stay. The root is taken by bisection: no libm.
[[nodiscard]] std::vector<std::uint32_t> geometric_counts(int bits, double from = 0.001, double to = 0.1, std::size_t count = 60);

/// The levels of exactly these vertex counts, each what is left when the order's other points are gone. InputError: no counts or more than 4096,
/// one below 4 or above (2^k+1)², counts that descend, an order of another field.
[[nodiscard]] Levels make_levels(int bits, const RemovalOrder& order, std::span<const std::uint32_t> vertex_counts);

/// The uniform grid of (2^j+1)² points, j = 0..k, as a single level: what adaptive meshes are compared with.
[[nodiscard]] Levels uniform_grid(int bits, int j);

/// The mesh of a level: conforming, vertices in grid order, one wedge each with its texture coordinate, faces depth first, counter-clockwise seen
/// from above, 2·(V − 1) − B of them where B vertices are on the border. Heights of points outside the level are not read. InputError for a level that does not exist.
[[nodiscard]] Mesh level_mesh(const HeightField& field, const Levels& levels, std::size_t level);

/// Heights of a level's surface against the field at every grid point.
struct LevelError {
  double rms_m = 0, max_m = 0;
};
[[nodiscard]] LevelError level_error(const HeightField& field, const Levels& levels, std::size_t level);
/// The same of the level's surface made of `coded` (heights of other units, say those that a decoder has) against the field.
[[nodiscard]] LevelError level_error(const HeightField& field, const HeightField& coded, const Levels& levels, std::size_t level);

}  // namespace etalon::terrain
