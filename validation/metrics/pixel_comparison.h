// Two pictures by thresholds, as idiff of OpenImageIO has them: how many pixels differ by more than so much, and what thresholds would pass.
// Formats may differ: values are compared as the numbers they mean (unorm 0..1). Does not explain anything (texel_diff.h does).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/image/image.h"

namespace etalon::validation {

/// A pixel is over a threshold where in some channel |a − b| is above the absolute *and* above relative · (|a| + |b|)/2.
struct PixelLimit {
  double absolute = 1e-6;
  double relative = 0;
  double percent = 0;                                     ///< of all pixels may be over it
  double hard = std::numeric_limits<double>::infinity();  ///< no pixel may differ by more
};

struct PixelThresholds {
  PixelLimit fail;
  PixelLimit warn;
  std::uint64_t allow_failures = 0;  ///< so many pixels may differ by any amount
};

enum class PixelVerdict : std::uint8_t { pass, warning, failure };

/// What one limit found.
struct PixelCount {
  std::uint64_t over = 0;       ///< pixels over absolute and relative
  std::uint64_t over_hard = 0;  ///< pixels with a difference above `hard`
};

/// The smallest value of one threshold of `fail` with which the pair does not fail, the others as they are; nothing where none does it (what is
/// not finite; more pixels above `hard` than are allowed). `hard` only where it is what fails.
struct PassingThresholds {
  std::optional<double> absolute, relative, percent, hard;
  std::uint64_t allow_failures = 0;
};

struct PixelComparison {
  std::uint64_t pixels = 0;
  int channels = 0;             ///< of the image with more; what the other lacks counts as 0
  std::uint64_t differing = 0;  ///< pixels of which any value differs
  double mean_error = 0;        ///< of |a − b| over all values of all channels
  double rms_error = 0;
  std::optional<double> psnr_db;                 ///< against the larger of 1 and the largest value; nothing where identical or not finite
  double max_error = 0;                          ///< infinite where one value is not finite and the other is another
  int max_x = -1, max_y = -1, max_channel = -1;  ///< the first place that reaches it, row 0 lowest; −1 where nothing differs
  double max_relative = 0;                       ///< largest |a − b| / ((|a| + |b|)/2)
  PixelCount fail, warn;
  PassingThresholds passing;
  PixelVerdict verdict = PixelVerdict::pass;
};

/// NaN equals NaN, and infinity infinity of its sign. Sums are taken in double over each row, then over the rows: the same bytes for any number of
/// threads. InputError where the sizes differ or an image is empty.
[[nodiscard]] PixelComparison compare_pixels(const Image& a, const Image& b, const PixelThresholds& thresholds);

/// The numbers that row `y` means, texel by texel, `channels` each (0 where the image has fewer): unorm 0..1, floats themselves, integers themselves.
void row_values(const Image& image, int y, int channels, double* out);

}  // namespace etalon::validation
