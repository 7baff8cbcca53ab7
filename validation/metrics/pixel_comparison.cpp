#include "validation/metrics/pixel_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "validation/metrics/decibel.h"
#include "validation/metrics/image_difference.h"

namespace etalon::validation {
namespace {

// What each differing texel needs of one threshold to be within it: the largest of all, and, where some texels may fail, every one.
struct LargestNeeds {
  double largest = 0;
  std::vector<double> all;

  void add(double need, bool keep) {
    largest = std::max(largest, need);
    if (keep && need > 0) all.push_back(need);
  }
  void add(const LargestNeeds& other) {
    largest = std::max(largest, other.largest);
    all.insert(all.end(), other.all.begin(), other.all.end());
  }
  // The smallest value that at most `tolerated` texels exceed.
  double but(std::uint64_t tolerated) {
    if (tolerated == 0) return largest;
    if (tolerated >= all.size()) return 0;
    const auto place = all.begin() + static_cast<std::ptrdiff_t>(tolerated);
    std::nth_element(all.begin(), place, all.end(), std::greater<>());
    return *place;
  }
};
enum Need : std::size_t { kAbsolute, kRelative, kHard };

struct RowSums {
  std::uint64_t differing = 0;
  double absolute = 0, squared = 0, largest = 1;
  double max_error = 0, max_relative = 0;
  int max_x = -1, max_channel = -1;
  PixelCount fail, warn;
  std::array<LargestNeeds, 3> needs;
};

double difference(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  if (!std::isfinite(a) || !std::isfinite(b)) return std::numeric_limits<double>::infinity();
  return std::abs(a - b);
}

// Formats whose equal bytes add nothing: their values cannot exceed 1, nor be NaN.
bool is_unorm(const Image& a, const Image& b) {
  const ChannelType type = a.format().type;
  return a.format() == b.format() && (type == ChannelType::unorm8 || type == ChannelType::srgb8 || type == ChannelType::unorm16);
}

// A range of texels of a row.
struct Run {
  int begin = 0, end = 0;
};

// The next run of texels, from `x` on, that hold other bytes; begins at the row's end where there is none.
template <class Texel>
Run next_run(const std::byte* a, const std::byte* b, int x, int width) {
  const auto differs = [&](int i) {
    Texel p, q;
    const std::size_t at = static_cast<std::size_t>(i) * sizeof(Texel);
    std::memcpy(&p, a + at, sizeof(Texel));
    std::memcpy(&q, b + at, sizeof(Texel));
    return p != q;
  };
  // Equal stretches are passed over 64 texels at a time.
  constexpr int kStride = 64;
  while (x + kStride <= width && std::memcmp(a + static_cast<std::size_t>(x) * sizeof(Texel),
                                             b + static_cast<std::size_t>(x) * sizeof(Texel), kStride * sizeof(Texel)) == 0)
    x += kStride;
  while (x < width && !differs(x)) ++x;
  int end = x;
  while (end < width && differs(end)) ++end;
  return {x, end};
}

Run next_run(const Image& a, const Image& b, int x, int y) {
  const std::byte *p = a.texel(0, y), *q = b.texel(0, y);
  switch (bytes_per_texel(a.format())) {
    case 1: return next_run<std::uint8_t>(p, q, x, a.width());
    case 2: return next_run<std::uint16_t>(p, q, x, a.width());
    case 3: return next_run<std::array<std::uint8_t, 3>>(p, q, x, a.width());
    case 4: return next_run<std::uint32_t>(p, q, x, a.width());
    case 6: return next_run<std::array<std::uint16_t, 3>>(p, q, x, a.width());
    case 8: return next_run<std::uint64_t>(p, q, x, a.width());
    default: return {x, a.width()};
  }
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

void compare_run(const double* a, const double* b, Run run, int channels, const PixelThresholds& thresholds, RowSums& sums) {
  const bool keep_needs = thresholds.fail.percent > 0 || thresholds.allow_failures > 0;
  PixelState fail(thresholds.fail, sums.fail), warn(thresholds.warn, sums.warn);
  for (int x = run.begin; x < run.end; ++x) {
    bool differs = false;
    std::array<double, 3> need{};
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
      if (error > mean * thresholds.fail.relative) need[kAbsolute] = std::max(need[kAbsolute], error);
      if (error > thresholds.fail.absolute) need[kRelative] = std::max(need[kRelative], relative);
      need[kHard] = std::max(need[kHard], error);
      fail.add(error, mean);
      warn.add(error, mean);
    }
    if (!differs) continue;
    ++sums.differing;
    for (std::size_t n = 0; n < need.size(); ++n) sums.needs[n].add(need[n], keep_needs);
    fail.end_pixel();
    warn.end_pixel();
  }
}

void run_values(const Image& image, Run run, int y, int channels, double* out) {
  static const std::vector<double> kUnorm8 = [] {
    std::vector<double> values(256);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i) / 255;
    return values;
  }();
  const int own = image.format().channels;
  const auto fill = [&](const auto* stored, const auto& value_of) {
    for (int x = run.begin; x < run.end; ++x, stored += own, out += channels)
      for (int c = 0; c < channels; ++c) out[c] = c < own ? value_of(stored[c]) : 0.0;
  };
  switch (image.format().type) {
    case ChannelType::unorm8:
    case ChannelType::srgb8: return fill(image.channels<std::uint8_t>(run.begin, y), [](std::uint8_t i) { return kUnorm8[i]; });
    case ChannelType::unorm16: return fill(image.channels<std::uint16_t>(run.begin, y), [](std::uint16_t i) { return i / 65535.0; });
    case ChannelType::half: return fill(image.channels<std::uint16_t>(run.begin, y), [](std::uint16_t bits) { return half_value(bits); });
    case ChannelType::float32: return fill(image.channels<float>(run.begin, y), [](float value) { return double{value}; });
    case ChannelType::uint32:
      return fill(image.channels<std::uint32_t>(run.begin, y), [](std::uint32_t value) { return static_cast<double>(value); });
  }
}

bool over_percent(const PixelLimit& limit, std::uint64_t over, std::uint64_t pixels) {
  return static_cast<double>(over) > limit.percent / 100 * static_cast<double>(pixels);
}

bool too_many(const PixelLimit& limit, const PixelCount& count, std::uint64_t pixels, std::uint64_t allowed) {
  return (over_percent(limit, count.over, pixels) && count.over > allowed) || count.over_hard > allowed;
}

// The smallest percentage that `over` of `pixels` does not exceed, by too_many()'s own arithmetic.
double passing_percent(std::uint64_t over, std::uint64_t pixels) {
  double percent = 100 * static_cast<double>(over) / static_cast<double>(pixels);
  while (static_cast<double>(over) > percent / 100 * static_cast<double>(pixels)) percent = std::nextafter(percent, 1e9);
  return percent;
}

// The smallest relative threshold that no value exceeds: the quotient, or the number above it where its product rounds down.
double passing_relative(double quotient) { return quotient == 0 ? 0 : std::nextafter(quotient, 3.0); }

PassingThresholds passing_thresholds(std::array<LargestNeeds, 3>& needs, const PixelThresholds& thresholds, const PixelCount& count,
                                     std::uint64_t pixels) {
  const PixelLimit& limit = thresholds.fail;
  const std::uint64_t allowed = thresholds.allow_failures;
  const bool over = over_percent(limit, count.over, pixels);
  PassingThresholds passing;
  passing.allow_failures = std::max(over ? count.over : 0, count.over_hard);
  if (count.over_hard > allowed) {  // then only what speaks of single texels helps
    const double hard = needs[kHard].but(allowed);
    if (std::isfinite(hard) && (!over || count.over <= allowed)) passing.hard = hard;
    return passing;
  }
  const auto share = static_cast<std::uint64_t>(limit.percent / 100 * static_cast<double>(pixels));
  const std::uint64_t tolerated = std::max(allowed, share);
  if (const double absolute = needs[kAbsolute].but(tolerated); std::isfinite(absolute)) passing.absolute = absolute;
  if (const double relative = needs[kRelative].but(tolerated); std::isfinite(relative)) passing.relative = passing_relative(relative);
  passing.percent = count.over <= allowed ? 0 : passing_percent(count.over, pixels);
  return passing;
}

}  // namespace

void row_values(const Image& image, int y, int channels, double* out) { run_values(image, {0, image.width()}, y, channels, out); }

PixelComparison compare_pixels(const Image& a, const Image& b, const PixelThresholds& thresholds) {
  if (a.empty() || b.empty() || a.width() != b.width() || a.height() != b.height())
    throw InputError(fmt::format("expected two images of one size, got {}x{} and {}x{}", a.width(), a.height(), b.width(), b.height()));
  PixelComparison result;
  result.pixels = a.texel_count();
  result.channels = std::max(a.format().channels, b.format().channels);
  std::vector<RowSums> rows(static_cast<std::size_t>(a.height()));
  const bool unorm = is_unorm(a, b);
  parallel_for_blocks(rows.size(), 16, [&](std::size_t begin, std::size_t end) {
    const std::size_t values = static_cast<std::size_t>(a.width()) * static_cast<std::size_t>(result.channels);
    std::vector<double> row_a(values), row_b(values);
    for (std::size_t row = begin; row < end; ++row) {
      const int y = static_cast<int>(row);
      for (Run run{0, 0}; run.end < a.width();) {
        run = unorm ? next_run(a, b, run.end, y) : Run{0, a.width()};
        if (run.begin == run.end) break;
        run_values(a, run, y, result.channels, row_a.data());
        run_values(b, run, y, result.channels, row_b.data());
        compare_run(row_a.data(), row_b.data(), run, result.channels, thresholds, rows[row]);
      }
    }
  });
  RowSums sum;
  for (std::size_t y = 0; y < rows.size(); ++y) {
    const RowSums& row = rows[y];
    sum.absolute += row.absolute;
    sum.squared += row.squared;
    sum.largest = std::max(sum.largest, row.largest);
    for (std::size_t n = 0; n < sum.needs.size(); ++n) sum.needs[n].add(row.needs[n]);
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
  result.passing = passing_thresholds(sum.needs, thresholds, result.fail, result.pixels);
  if (too_many(thresholds.fail, result.fail, result.pixels, thresholds.allow_failures))
    result.verdict = PixelVerdict::failure;
  else if (too_many(thresholds.warn, result.warn, result.pixels, thresholds.allow_failures))
    result.verdict = PixelVerdict::warning;
  return result;
}

}  // namespace etalon::validation
