// How far apart two images are: squared errors summed exactly for integer formats, the largest difference and where, a histogram.
// Does not decide who is right, and knows no tolerance.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/image/image.h"

namespace etalon::validation {

/// Of one channel. In units of the stored number: unorm8, srgb8: 0..255; unorm16: 0..65535; half, float32: the value; uint32: see below.
struct ChannelDifference {
  /// Integer formats: the exact sum of squared differences. A channel has at most 2^30 texels, so sse < 2^62, and four channels sum below 2^64.
  std::uint64_t sse = 0;
  /// half, float32: the sum in double, each row left to right, then the rows from 0 up. Integer formats: sse again.
  double squared_error = 0;
  double max_abs = 0;            ///< largest |a − b|
  int max_x = -1, max_y = -1;    ///< first texel in row order that reaches it; −1 where all are equal
  std::uint64_t differing = 0;   ///< samples whose stored bits differ
  std::uint64_t non_finite = 0;  ///< samples whose bits differ and of which one is inf or NaN: in no sum and no maximum
};

/// `count` samples differ by an amount in [low, high].
struct HistogramBin {
  std::uint64_t low = 0;
  std::uint64_t high = 0;
  std::uint64_t count = 0;
  friend bool operator==(const HistogramBin&, const HistogramBin&) = default;
};

struct ImageDifference {
  int width = 0;
  int height = 0;
  PixelFormat format;
  std::uint64_t texels = 0;            ///< compared: all, or those the mask keeps
  std::uint64_t differing_texels = 0;  ///< of those, how many have any bit different
  bool identical = true;               ///< differing_texels == 0
  std::vector<ChannelDifference> channels;
  ChannelDifference total;  ///< over all channels; sums added in channel order
  /// Over all channels, ascending, bins that are empty left out. unorm8, srgb8, unorm16: one bin a value of |a − b|. half, float32: distance in
  /// units in the last place (representable numbers from one to the other, −0 = +0), bins 0, 1, 2..3, 4..7, …; non-finite samples are left out.
  /// uint32 (ids, whose difference means nothing): bins 0 (equal) and 1 (different), and squared_error and max_abs count in the same way.
  std::vector<HistogramBin> histogram;

  [[nodiscard]] std::uint64_t samples() const { return texels * channels.size(); }
  /// Mean squared error over samples(), in squared units of the stored number; 0 without samples.
  [[nodiscard]] double mse() const;
  /// dB against the format's peak (255, 65535, 1.0), rounded to 1e-4; nothing where identical, for uint32, or where every difference is non-finite.
  [[nodiscard]] std::optional<double> psnr_db() const;
};

/// Compares a and b texel by texel. `mask`: R unorm8 of the same size, texels of 0 are left out. Exact for integer formats; for floats the
/// doubles are summed in a fixed order: the same result for any number of threads.
/// InputError where sizes or formats differ, an image is empty, or the mask does not fit.
[[nodiscard]] ImageDifference measure_difference(const Image& a, const Image& b, const Image* mask = nullptr);

/// The largest stored number that means "white": 255, 65535, or 1.
[[nodiscard]] double peak_value(ChannelType type);

/// A binary16 bit pattern as the exact double it means.
[[nodiscard]] double half_value(std::uint16_t bits);

}  // namespace etalon::validation
