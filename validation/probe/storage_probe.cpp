// Storage: exact numbers copied into targets of half and of 8 bits.
#include <algorithm>
#include <cmath>

#include "core/math/half.h"
#include "validation/probe/device_probe.h"
#include "validation/probe/lookup_sheet.h"

namespace etalon::validation {
namespace {

// Between neighbouring halves: the quarter points, the midpoint, and its neighbours in float32; all exponents, both signs, and overflow.
std::vector<float> half_values() {
  std::vector<float> values;
  for (int exponent = -13; exponent <= 15; ++exponent) {
    for (const int mantissa : {0, 1, 2, 511, 1022, 1023}) {
      for (const double eighth : {0.0, 1.0, 2.0, 4.0 - 0x1p-9, 4.0, 4.0 + 0x1p-9, 6.0, 7.0}) {
        const double value = std::ldexp(1024 + mantissa + eighth / 8, exponent - 10);
        values.push_back(static_cast<float>(value));
        values.push_back(static_cast<float>(-value));
      }
    }
  }
  for (const double value : {65504.0, 65519.0, 65520.0, 65536.0, 1e6}) values.push_back(static_cast<float>(value));
  return values;
}

std::optional<HalfRounding> half_rounding(Renderer& device, const std::vector<float>& values) {
  const Image image = store(device, values, {ChannelType::half, 1});
  const auto* stored = image.channels<std::uint16_t>(0, 0);
  bool nearest = true, toward_zero = true;
  for (std::size_t n = 0; n < values.size(); ++n) {
    nearest = nearest && stored[n] == half_nearest_even(static_cast<double>(values[n]));
    toward_zero = toward_zero && stored[n] == half_toward_zero(static_cast<double>(values[n]));
  }
  if (nearest == toward_zero) return std::nullopt;
  return nearest ? HalfRounding::nearest_even : HalfRounding::toward_zero;
}

// Fractions that a device's own product v·255 in float32 cannot carry across a decision.
std::optional<bool> unorm8_nearest(Renderer& device) {
  std::vector<float> values;
  for (int step = 0; step < 255; ++step)
    for (const double fraction : {0.125, 0.375, 0.49, 0.51, 0.75, 0.9375}) values.push_back(static_cast<float>((step + fraction) / 255));
  const Image image = store(device, values, {ChannelType::unorm8, 1});
  bool nearest = true, toward_zero = true;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double value = static_cast<double>(values[n]) * 255;
    const int stored = image.channels<std::uint8_t>(0, 0)[n];
    nearest = nearest && stored == static_cast<int>(std::floor(value + 0.5));
    toward_zero = toward_zero && stored == static_cast<int>(std::floor(value));
  }
  if (nearest == toward_zero) return std::nullopt;
  return nearest;
}

}  // namespace

StorageFinding probe_storage(Renderer& device) {
  const std::vector<float> values = half_values();
  return {.half = half_rounding(device, values), .half_values = values.size(), .unorm8_nearest = unorm8_nearest(device)};
}

}  // namespace etalon::validation
