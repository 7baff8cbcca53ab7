#include "core/terrain/height_field.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"
#include "core/math/half.h"

namespace etalon::terrain {

namespace {

// Higher than any mountain, lower than any sea floor of a terrain that one looks at from above.
constexpr double kHighest_m = 9000;

double sample(const Image& dem, int x, int y, const DemOptions& options) {
  switch (dem.format().type) {
    case ChannelType::float32: return *dem.channels<float>(x, y);
    case ChannelType::half: return half_to_double(*dem.channels<std::uint16_t>(x, y));
    case ChannelType::unorm16: return *dem.channels<std::uint16_t>(x, y) * options.sample_scale + options.sample_offset;
    default: return *dem.channels<std::uint8_t>(x, y) * options.sample_scale + options.sample_offset;
  }
}

DemWindow window_of(const Image& dem, const DemOptions& options) {
  if (!options.window) {
    const int size = dem.width() < dem.height() ? dem.width() : dem.height();
    return {(dem.width() - size) / 2, (dem.height() - size) / 2, size};
  }
  const DemWindow w = *options.window;
  if (w.column < 0 || w.row < 0 || w.size < 1 || w.column > dem.width() - w.size || w.row > dem.height() - w.size)
    throw InputError(fmt::format("DEM window: expected inside {}x{}, got {}x{} at column {}, row {}", dem.width(), dem.height(), w.size,
                                 w.size, w.column, w.row));
  return w;
}

void check_samples(const Image& dem, const DemWindow& window, const DemOptions& options) {
  std::size_t bad = 0;
  int column = 0, row = 0;
  for (int y = window.row; y < window.row + window.size; ++y)
    for (int x = window.column; x < window.column + window.size; ++x) {
      const double h = sample(dem, x, y, options);
      if (h >= -kHighest_m && h <= kHighest_m) continue;
      if (bad++ == 0) column = x, row = y;
    }
  if (bad == 0) return;
  throw InputError(
      fmt::format("DEM: {} of {} heights are no number, or no data: expected {} to {} m, got {} first at column {}, row {} from below; "
                  "fill the holes, or cut DEM and image to a part without them",
                  bad, static_cast<std::size_t>(window.size) * static_cast<std::size_t>(window.size), -kHighest_m, kHighest_m,
                  sample(dem, column, row, options), column, row));
}

std::int32_t in_units(double metres, double unit) {
  const double units = std::nearbyint(metres / unit);
  if (!(std::fabs(units) < kMaxHeight))
    throw InputError(fmt::format("height: expected less than 2^24 units of {} m, got {} m", unit, metres));
  return static_cast<std::int32_t>(units);
}

bool is_step(double x) { return x >= 1 / kMaxStep && x <= kMaxStep; }

void check_options(const Image& dem, const DemOptions& options) {
  if (dem.empty()) throw InputError("DEM: expected an image of one channel, got none");
  if (dem.format().channels != 1 || dem.format().type == ChannelType::uint32)
    throw InputError(fmt::format("DEM: expected one channel of heights in float32, half, 16 or 8 bit, got {}", to_string(dem.format())));
  if (options.grid_bits && (*options.grid_bits < kMinGridBits || *options.grid_bits > kMaxGridBits))
    throw InputError(fmt::format("grid: expected (2^k+1)² points, k {} to {}, got {}", kMinGridBits, kMaxGridBits, *options.grid_bits));
  if (!is_step(options.dem_spacing) || !is_step(options.unit))
    throw InputError(
        fmt::format("DEM: expected a spacing and a unit of 2^-20 to 2^20 m, got {} and {}", options.dem_spacing, options.unit));
  if (!std::isfinite(options.sample_scale) || !std::isfinite(options.sample_offset))
    throw InputError(fmt::format("DEM: expected a finite scale and offset, got {} and {}", options.sample_scale, options.sample_offset));
}

int default_bits(int samples) {
  int bits = kMinGridBits;
  while (bits < kMaxGridBits && (1 << (bits + 1)) + 1 <= samples) ++bits;
  return bits;
}

// The two samples beside a grid point, and the share of the second: exact, since the denominator is a power of two.
struct Between {
  int low, high;
  double share;
};
Between between(int i, const HeightField& field, int samples) {
  const std::int64_t at = static_cast<std::int64_t>(i) * (samples - 1);
  const int low = static_cast<int>(at >> field.bits);
  const double share = static_cast<double>(at - (static_cast<std::int64_t>(low) << field.bits)) / field.steps();
  return {low, low + 1 < samples ? low + 1 : low, share};
}

}  // namespace

void validate_grid(const HeightField& field) {
  if (field.bits < kMinGridBits || field.bits > kMaxGridBits)
    throw InputError(fmt::format("height field: expected k {} to {}, got {}", kMinGridBits, kMaxGridBits, field.bits));
  if (!is_step(field.spacing) || !is_step(field.unit))
    throw InputError(fmt::format("height field: expected spacing and unit of 2^-20 to 2^20 m, got {} and {}", field.spacing, field.unit));
  if (!(std::fabs(field.uv_start) <= kMaxStep) || !(std::fabs(field.uv_step) <= kMaxStep))
    throw InputError(
        fmt::format("height field: expected texture coordinates within 2^20, got start {} and step {}", field.uv_start, field.uv_step));
}

void validate(const HeightField& field) {
  validate_grid(field);
  if (field.heights.size() != field.point_count())
    throw InputError(fmt::format("height field: expected {} heights, got {}", field.point_count(), field.heights.size()));
  for (const std::int32_t h : field.heights)
    if (h <= -kMaxHeight || h >= kMaxHeight) throw InputError(fmt::format("height: expected less than 2^24 units, got {}", h));
}

DemResult make_height_field(const Image& dem, const DemOptions& options) {
  check_options(dem, options);
  const DemWindow window = window_of(dem, options);
  if (window.size < (1 << kMinGridBits) + 1) throw InputError(fmt::format("DEM: expected at least 5x5 heights, got {0}x{0}", window.size));
  check_samples(dem, window, options);

  DemResult result;
  HeightField& field = result.field;
  field.bits = options.grid_bits.value_or(default_bits(window.size));
  field.spacing = options.dem_spacing * (window.size - 1) / field.steps();
  field.unit = options.unit;
  if (!is_step(field.spacing)) throw InputError(fmt::format("DEM: expected points 2^-20 to 2^20 m apart, got {} m", field.spacing));
  field.uv_start = 0.5 / window.size;
  field.uv_step = static_cast<double>(window.size - 1) / field.steps() / window.size;
  field.heights.resize(field.point_count());
  for (int j = 0; j < field.side(); ++j) {
    const Between y = between(j, field, window.size);
    for (int i = 0; i < field.side(); ++i) {
      const Between x = between(i, field, window.size);
      const auto at = [&](int column, int row) { return sample(dem, window.column + column, window.row + row, options); };
      const double below = at(x.low, y.low) * (1 - x.share) + at(x.high, y.low) * x.share;
      const double above = at(x.low, y.high) * (1 - x.share) + at(x.high, y.high) * x.share;
      field.heights[field.index(i, j)] = in_units(below * (1 - y.share) + above * y.share, field.unit);
    }
  }

  if (window.size != dem.width() || window.size != dem.height())
    result.notes.push_back(fmt::format("of {}x{} heights, the {}x{} from column {} and row {} (from below) on are taken", dem.width(),
                                       dem.height(), window.size, window.size, window.column, window.row));
  if (window.size != field.side())
    result.notes.push_back(
        fmt::format("{0}x{0} heights are brought to {1}x{1} points, {2} m apart, by bilinear interpolation; the corners stay", window.size,
                    field.side(), field.spacing));
  if (bytes_per_channel(dem.format().type) == 1)
    result.warnings.push_back(fmt::format("heights of 8 bits: steps of {} m are terraces, not terrain", options.sample_scale));
  return result;
}

HeightField with_unit(const HeightField& field, double unit) {
  validate(field);
  if (!is_step(unit)) throw InputError(fmt::format("unit: expected 2^-20 to 2^20 m, got {}", unit));
  HeightField result = field;
  result.unit = unit;
  for (std::int32_t& h : result.heights) h = in_units(h * field.unit, unit);
  return result;
}

}  // namespace etalon::terrain
