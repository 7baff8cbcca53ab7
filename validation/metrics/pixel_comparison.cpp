#include "validation/metrics/pixel_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "validation/metrics/decibel.h"
#include "validation/metrics/image_difference.h"

namespace etalon::validation {
namespace {

struct RowSums {
  std::uint64_t differing = 0;
  double absolute = 0, squared = 0, largest = 1;
  double max_error = 0, max_relative = 0, relative_over = 0;  // relative_over: of values above the absolute limit
  int max_x = -1, max_channel = -1;
  PixelCount fail, warn;
};

double difference(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  if (!std::isfinite(a) || !std::isfinite(b)) return std::numeric_limits<double>::infinity();
  return std::abs(a - b);
}

// Whether both rows hold the same bytes of a format whose values cannot exceed 1: then nothing is to be added.
bool same_bytes(const Image& a, const Image& b, int y) {
  const ChannelType type = a.format().type;
  if (a.format() != b.format() || (type != ChannelType::unorm8 && type != ChannelType::srgb8 && type != ChannelType::unorm16)) return false;
  const std::size_t size = static_cast<std::size_t>(a.width()) * static_cast<std::size_t>(bytes_per_texel(a.format()));
  return std::memcmp(a.texel(0, y), b.texel(0, y), size) == 0;
}

class PixelState {
 public:
  PixelState(const PixelLimit& limit, PixelCount& count) : limit_(limit), count_(count) {}
  void add(double error, double mean) {
    over_ |= error > limit_.absolute && error > mean * limit_.relative;
    hard_ |= error > limit_.hard;
  }
  void end_pixel() {
    count_.over += over_ ? 1 : 0;
    count_.over_hard += hard_ ? 1 : 0;
    over_ = hard_ = false;
  }

 private:
  const PixelLimit& limit_;
  PixelCount& count_;
  bool over_ = false, hard_ = false;
};

void compare_row(const double* a, const double* b, int width, int channels, const PixelThresholds& thresholds, RowSums& sums) {
  PixelState fail(thresholds.fail, sums.fail), warn(thresholds.warn, sums.warn);
  for (int x = 0; x < width; ++x) {
    bool differs = false;
    for (int c = 0; c < channels; ++c, ++a, ++b) {
      sums.largest = std::max({sums.largest, std::isfinite(*a) ? *a : 0, std::isfinite(*b) ? *b : 0});
      const double error = difference(*a, *b);
      if (error == 0) continue;
      differs = true;
      const double mean = std::isfinite(error) ? 0.5 * (std::abs(*a) + std::abs(*b)) : 0;  // what is not finite is over any share of it
      if (std::isfinite(error)) {
        sums.absolute += error;
        sums.squared += error * error;
      }
      if (error > sums.max_error) sums.max_error = error, sums.max_x = x, sums.max_channel = c;
      const double relative = std::isfinite(error) ? error / mean : error;
      sums.max_relative = std::max(sums.max_relative, relative);
      if (error > thresholds.fail.absolute) sums.relative_over = std::max(sums.relative_over, relative);
      fail.add(error, mean);
      warn.add(error, mean);
    }
    if (!differs) continue;
    ++sums.differing;
    fail.end_pixel();
    warn.end_pixel();
  }
}

bool too_many(const PixelLimit& limit, const PixelCount& count, std::uint64_t pixels, std::uint64_t allowed) {
  const bool over = static_cast<double>(count.over) > limit.percent / 100 * static_cast<double>(pixels) && count.over > allowed;
  return over || count.over_hard > allowed;
}

// The smallest percentage that `over` of `pixels` does not exceed, by too_many()'s own arithmetic.
double passing_percent(std::uint64_t over, std::uint64_t pixels) {
  double percent = 100 * static_cast<double>(over) / static_cast<double>(pixels);
  while (static_cast<double>(over) > percent / 100 * static_cast<double>(pixels)) percent = std::nextafter(percent, 1e9);
  return percent;
}

// The smallest relative threshold that no value exceeds: the quotient, or the number above it where its product rounds down.
double passing_relative(double quotient) { return quotient == 0 ? 0 : std::nextafter(quotient, 3.0); }

}  // namespace

void row_values(const Image& image, int y, int channels, double* out) {
  static const std::vector<double> kUnorm8 = [] {
    std::vector<double> values(256);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i) / 255;
    return values;
  }();
  const int own = image.format().channels;
  const auto fill = [&](const auto* stored, const auto& value_of) {
    for (int x = 0; x < image.width(); ++x, stored += own, out += channels)
      for (int c = 0; c < channels; ++c) out[c] = c < own ? value_of(stored[c]) : 0.0;
  };
  switch (image.format().type) {
    case ChannelType::unorm8:
    case ChannelType::srgb8: return fill(image.channels<std::uint8_t>(0, y), [](std::uint8_t i) { return kUnorm8[i]; });
    case ChannelType::unorm16: return fill(image.channels<std::uint16_t>(0, y), [](std::uint16_t i) { return i / 65535.0; });
    case ChannelType::half: return fill(image.channels<std::uint16_t>(0, y), [](std::uint16_t bits) { return half_value(bits); });
    case ChannelType::float32: return fill(image.channels<float>(0, y), [](float value) { return double{value}; });
    case ChannelType::uint32:
      return fill(image.channels<std::uint32_t>(0, y), [](std::uint32_t value) { return static_cast<double>(value); });
  }
}

PixelComparison compare_pixels(const Image& a, const Image& b, const PixelThresholds& thresholds) {
  if (a.empty() || b.empty() || a.width() != b.width() || a.height() != b.height())
    throw InputError(fmt::format("expected two images of one size, got {}x{} and {}x{}", a.width(), a.height(), b.width(), b.height()));
  PixelComparison result;
  result.pixels = a.texel_count();
  result.channels = std::max(a.format().channels, b.format().channels);
  std::vector<RowSums> rows(static_cast<std::size_t>(a.height()));
  parallel_for_blocks(rows.size(), 16, [&](std::size_t begin, std::size_t end) {
    const std::size_t values = static_cast<std::size_t>(a.width()) * static_cast<std::size_t>(result.channels);
    std::vector<double> row_a(values), row_b(values);
    for (std::size_t row = begin; row < end; ++row) {
      const int y = static_cast<int>(row);
      if (same_bytes(a, b, y)) continue;
      row_values(a, y, result.channels, row_a.data());
      row_values(b, y, result.channels, row_b.data());
      compare_row(row_a.data(), row_b.data(), a.width(), result.channels, thresholds, rows[row]);
    }
  });
  RowSums sum;
  for (std::size_t y = 0; y < rows.size(); ++y) {
    const RowSums& row = rows[y];
    sum.absolute += row.absolute;
    sum.squared += row.squared;
    sum.largest = std::max(sum.largest, row.largest);
    sum.relative_over = std::max(sum.relative_over, row.relative_over);
    result.differing += row.differing;
    result.max_relative = std::max(result.max_relative, row.max_relative);
    if (row.max_error > result.max_error) {
      result.max_error = row.max_error;
      result.max_x = row.max_x, result.max_y = static_cast<int>(y), result.max_channel = row.max_channel;
    }
    for (const auto& [total, part] : {std::pair(&result.fail, &row.fail), std::pair(&result.warn, &row.warn)})
      total->over += part->over, total->over_hard += part->over_hard;
  }
  const double samples = static_cast<double>(result.pixels) * result.channels;
  result.mean_error = sum.absolute / samples;
  result.rms_error = std::sqrt(sum.squared / samples);
  result.psnr_db = psnr_db(sum.squared, result.pixels * static_cast<std::uint64_t>(result.channels), sum.largest);
  if (std::isfinite(result.max_error)) {
    result.passing.absolute = result.max_error;
    result.passing.relative = passing_relative(sum.relative_over);
  }
  result.passing.percent = passing_percent(result.fail.over, result.pixels);
  result.passing.allow_failures = result.fail.over;
  if (too_many(thresholds.fail, result.fail, result.pixels, thresholds.allow_failures))
    result.verdict = PixelVerdict::failure;
  else if (too_many(thresholds.warn, result.warn, result.pixels, thresholds.allow_failures))
    result.verdict = PixelVerdict::warning;
  return result;
}

}  // namespace etalon::validation
