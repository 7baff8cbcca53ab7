// A height field on (2^k+1)² grid points, heights as integers: the terrain M_0 of [Horbelt, Balmelli & Vetterli], and how a DEM becomes one.
//
// Model space is right-handed, +Y up: grid point (i, j) of a field with S = 2^k steps on a side is at x = (i − S/2)·spacing,
// y = height·unit, z = (S/2 − j)·spacing. i runs east along an image's columns, j north along its rows (row 0 is v = 0).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/math/vec.h"

namespace etalon::terrain {

inline constexpr int kMinGridBits = 2, kMaxGridBits = 12;
/// |height| in units is below this, so that float32 holds it.
inline constexpr std::int32_t kMaxHeight = 1 << 24;
/// Spacing and unit are in [1/kMaxStep, kMaxStep] metres, and texture coordinates within ±kMaxStep, so that all positions are far from float32's limits.
inline constexpr double kMaxStep = 1 << 20;

struct HeightField {
  int bits = 0;                       ///< k: 2..12
  double spacing = 1;                 ///< metres between neighbouring grid points
  double unit = 0x1p-6;               ///< metres of one step of height
  double uv_start = 0;                ///< texture coordinate of grid point 0 …
  double uv_step = 0;                 ///< … and from one grid point to the next, the same in u and v
  std::vector<std::int32_t> heights;  ///< (2^k+1)², row j after row j − 1, in units

  [[nodiscard]] int steps() const { return 1 << bits; }
  [[nodiscard]] int side() const { return steps() + 1; }
  [[nodiscard]] std::size_t point_count() const { return static_cast<std::size_t>(side()) * static_cast<std::size_t>(side()); }
  [[nodiscard]] std::uint32_t index(int i, int j) const {
    return static_cast<std::uint32_t>(j) * static_cast<std::uint32_t>(side()) + static_cast<std::uint32_t>(i);
  }
  [[nodiscard]] std::int32_t height(int i, int j) const { return heights[index(i, j)]; }
  /// Metres, in double, and rounded once to float32 in level_mesh().
  [[nodiscard]] Vec3d position(int i, int j) const {
    const double half = steps() / 2;
    return {(i - half) * spacing, height(i, j) * unit, (half - j) * spacing};
  }
  [[nodiscard]] Vec2d uv(int i, int j) const { return {uv_start + i * uv_step, uv_start + j * uv_step}; }
  friend bool operator==(const HeightField&, const HeightField&) = default;
};

/// InputError where a field breaks what is said above.
void validate(const HeightField& field);
/// The same for its numbers, without its heights.
void validate_grid(const HeightField& field);

/// Square part of a DEM, in its columns and rows (row 0 is v = 0).
struct DemWindow {
  int column = 0, row = 0, size = 0;
};

struct DemOptions {
  std::optional<DemWindow> window;  ///< none: the largest square, in the middle (an odd remainder is left at the far end)
  std::optional<int> grid_bits;     ///< k; none: the largest k of 2..12 with 2^k+1 <= the window's side
  double dem_spacing = 10;          ///< metres between neighbouring samples of the DEM
  double unit = 0x1p-6;             ///< metres of a step of the result's heights
  double sample_scale = 1;          ///< metres of a step of an integer DEM (8 and 16 bit)
  double sample_offset = 0;         ///< metres of its sample 0
};

struct DemResult {
  HeightField field;
  std::vector<std::string> notes;     ///< what was done: window, resampling
  std::vector<std::string> warnings;  ///< what the user should doubt: heights of 8 bits
};

/// A DEM of one channel (float32, half, unorm16, unorm8) as a height field. The corner samples of the window are kept; between them bilinear
/// at i·(size − 1)/2^k, the heights rounded half to even to units; where the window has 2^k+1 samples all are kept. A texture of the DEM's whole
/// extent is addressed by sample centres: sample c of a window of n samples is at (c + ½)/n, so the image must be cut as the DEM is.
/// InputError: not one channel, uint32, a window outside or of less than 5 samples, options out of range, heights that are no number, no-data
/// values (below −9000 m or above 9000 m: −9999, −32768, 3.4e38 …; counted, the first one named) or do not fit in units.
[[nodiscard]] DemResult make_height_field(const Image& dem, const DemOptions& options = {});

/// The same terrain with coarser units: heights rounded to multiples of `unit` metres (half to even). For streams of fewer bits.
[[nodiscard]] HeightField with_unit(const HeightField& field, double unit);

}  // namespace etalon::terrain
