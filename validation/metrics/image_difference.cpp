#include "validation/metrics/image_difference.h"

#include <bit>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "validation/metrics/decibel.h"

namespace etalon::validation {
namespace {

/// What one row contributes; rows are added from 0 up, so threads cannot matter.
struct RowDifference {
  std::uint64_t texels = 0;
  std::uint64_t differing_texels = 0;
  std::vector<ChannelDifference> channels;
  std::map<std::uint64_t, std::uint64_t> histogram;  // lower end of the bin → count
};

std::uint64_t log_bin(std::uint64_t ulps) { return ulps == 0 ? 0 : std::uint64_t{1} << (std::bit_width(ulps) - 1); }

// Maps the bit patterns of a float format, whose sign is the top bit, to integers in the order of the numbers, with −0 = +0.
std::int64_t ordered(std::uint32_t bits, std::uint32_t sign_bit) {
  const auto magnitude = static_cast<std::int64_t>(bits & (sign_bit - 1));
  return (bits & sign_bit) ? -magnitude : magnitude;
}

/// Two stored samples: bits equal or not, difference as a number, bin of the histogram.
struct SampleDifference {
  bool bits_differ = false;
  bool finite = true;
  double magnitude = 0;
  std::uint64_t squared = 0;  // integer formats
  std::uint64_t bin = 0;
};

SampleDifference of_integers(std::uint32_t a, std::uint32_t b) {
  const std::uint64_t d = a > b ? a - b : b - a;
  return {d != 0, true, static_cast<double>(d), d * d, d};
}

SampleDifference of_floats(double a, double b, std::uint32_t a_bits, std::uint32_t b_bits, std::uint32_t sign_bit) {
  SampleDifference result;
  result.bits_differ = a_bits != b_bits;
  if (!result.bits_differ) return result;
  result.finite = std::isfinite(a) && std::isfinite(b);
  if (!result.finite) return result;
  result.magnitude = std::fabs(a - b);
  const std::int64_t ulps = ordered(a_bits, sign_bit) - ordered(b_bits, sign_bit);
  result.bin = log_bin(static_cast<std::uint64_t>(ulps < 0 ? -ulps : ulps));
  return result;
}

SampleDifference compare_sample(const Image& a, const Image& b, int x, int y, int c) {
  switch (a.format().type) {
    case ChannelType::unorm8:
    case ChannelType::srgb8: return of_integers(a.channels<std::uint8_t>(x, y)[c], b.channels<std::uint8_t>(x, y)[c]);
    case ChannelType::unorm16: return of_integers(a.channels<std::uint16_t>(x, y)[c], b.channels<std::uint16_t>(x, y)[c]);
    case ChannelType::uint32: {
      const bool differ = a.channels<std::uint32_t>(x, y)[c] != b.channels<std::uint32_t>(x, y)[c];
      return {differ, true, differ ? 1.0 : 0.0, differ ? 1u : 0u, differ ? 1u : 0u};
    }
    case ChannelType::half: {
      const std::uint16_t ha = a.channels<std::uint16_t>(x, y)[c];
      const std::uint16_t hb = b.channels<std::uint16_t>(x, y)[c];
      return of_floats(half_value(ha), half_value(hb), ha, hb, 0x8000u);
    }
    case ChannelType::float32: {
      const float fa = a.channels<float>(x, y)[c];
      const float fb = b.channels<float>(x, y)[c];
      return of_floats(fa, fb, std::bit_cast<std::uint32_t>(fa), std::bit_cast<std::uint32_t>(fb), 0x80000000u);
    }
  }
  return {};
}

bool is_integer(ChannelType type) { return type != ChannelType::half && type != ChannelType::float32; }

void add_sample(ChannelDifference& channel, const SampleDifference& sample, bool integer, int x, int y) {
  if (sample.bits_differ) ++channel.differing;
  if (!sample.finite) {
    ++channel.non_finite;
    return;
  }
  channel.sse += sample.squared;
  if (!integer) channel.squared_error += sample.magnitude * sample.magnitude;
  if (sample.magnitude > channel.max_abs) {
    channel.max_abs = sample.magnitude;
    channel.max_x = x;
    channel.max_y = y;
  }
}

RowDifference compare_row(const Image& a, const Image& b, const Image* mask, int y) {
  const bool integer = is_integer(a.format().type);
  RowDifference row;
  row.channels.resize(static_cast<std::size_t>(a.format().channels));
  std::vector<std::uint64_t> small(256, 0);  // the common bins without a map look-up
  for (int x = 0; x < a.width(); ++x) {
    if (mask != nullptr && *mask->channels<std::uint8_t>(x, y) == 0) continue;
    ++row.texels;
    bool texel_differs = false;
    for (int c = 0; c < a.format().channels; ++c) {
      const SampleDifference sample = compare_sample(a, b, x, y, c);
      texel_differs = texel_differs || sample.bits_differ;
      add_sample(row.channels[static_cast<std::size_t>(c)], sample, integer, x, y);
      if (!sample.finite) continue;
      if (sample.bin < small.size())
        ++small[sample.bin];
      else
        ++row.histogram[sample.bin];
    }
    if (texel_differs) ++row.differing_texels;
  }
  for (std::size_t bin = 0; bin < small.size(); ++bin) {
    if (small[bin] != 0) row.histogram[bin] = small[bin];
  }
  return row;
}

void add_channel(ChannelDifference& sum, const ChannelDifference& part) {
  sum.sse += part.sse;
  sum.squared_error += part.squared_error;
  sum.differing += part.differing;
  sum.non_finite += part.non_finite;
  const bool first_in_row_order = part.max_y < sum.max_y || (part.max_y == sum.max_y && part.max_x < sum.max_x);
  if (part.max_abs > sum.max_abs || (part.max_abs == sum.max_abs && part.max_abs > 0 && first_in_row_order)) {
    sum.max_abs = part.max_abs;
    sum.max_x = part.max_x;
    sum.max_y = part.max_y;
  }
}

void check_comparable(const Image& a, const Image& b, const Image* mask) {
  if (a.empty() || b.empty()) throw InputError("image difference: an image is empty");
  if (a.width() != b.width() || a.height() != b.height()) {
    throw InputError(fmt::format("image difference: sizes differ, {}x{} and {}x{}", a.width(), a.height(), b.width(), b.height()));
  }
  if (a.format() != b.format()) {
    throw InputError(fmt::format("image difference: formats differ, {} and {}", to_string(a.format()), to_string(b.format())));
  }
  if (mask == nullptr) return;
  if (mask->width() != a.width() || mask->height() != a.height() || mask->format() != PixelFormat{ChannelType::unorm8, 1}) {
    throw InputError(fmt::format("image difference: the mask must be r unorm8 of {}x{}, got {} of {}x{}", a.width(), a.height(),
                                 to_string(mask->format()), mask->width(), mask->height()));
  }
}

std::uint64_t bin_high(ChannelType type, std::uint64_t low) { return is_integer(type) || low == 0 ? low : 2 * low - 1; }

}  // namespace

double half_value(std::uint16_t bits) {
  const int exponent = (bits >> 10) & 0x1F;
  const int fraction = bits & 0x3FF;
  const double sign = (bits & 0x8000) ? -1.0 : 1.0;
  if (exponent == 31) {
    return fraction != 0 ? std::numeric_limits<double>::quiet_NaN() : sign * std::numeric_limits<double>::infinity();
  }
  if (exponent == 0) return sign * std::ldexp(fraction, -24);
  return sign * std::ldexp(1024 + fraction, exponent - 25);
}

double peak_value(ChannelType type) {
  switch (type) {
    case ChannelType::unorm8:
    case ChannelType::srgb8: return 255;
    case ChannelType::unorm16: return 65535;
    case ChannelType::half:
    case ChannelType::float32:
    case ChannelType::uint32: return 1;
  }
  return 1;
}

double ImageDifference::mse() const { return samples() == 0 ? 0.0 : total.squared_error / static_cast<double>(samples()); }

std::optional<double> ImageDifference::psnr_db() const {
  if (identical || format.type == ChannelType::uint32) return std::nullopt;
  return validation::psnr_db(total.squared_error, samples(), peak_value(format.type));
}

ImageDifference measure_difference(const Image& a, const Image& b, const Image* mask) {
  check_comparable(a, b, mask);
  std::vector<RowDifference> rows(static_cast<std::size_t>(a.height()));
  parallel_for(rows.size(), [&](std::size_t y) { rows[y] = compare_row(a, b, mask, static_cast<int>(y)); });

  ImageDifference result;
  result.width = a.width();
  result.height = a.height();
  result.format = a.format();
  result.channels.resize(static_cast<std::size_t>(a.format().channels));
  std::map<std::uint64_t, std::uint64_t> histogram;
  for (const RowDifference& row : rows) {
    result.texels += row.texels;
    result.differing_texels += row.differing_texels;
    for (std::size_t c = 0; c < row.channels.size(); ++c) add_channel(result.channels[c], row.channels[c]);
    for (const auto& [low, count] : row.histogram) histogram[low] += count;
  }
  result.identical = result.differing_texels == 0;
  for (ChannelDifference& channel : result.channels) {
    if (is_integer(a.format().type)) channel.squared_error = static_cast<double>(channel.sse);
    add_channel(result.total, channel);
  }
  if (is_integer(a.format().type)) result.total.squared_error = static_cast<double>(result.total.sse);
  for (const auto& [low, count] : histogram) result.histogram.push_back({low, bin_high(a.format().type, low), count});
  return result;
}

}  // namespace etalon::validation
