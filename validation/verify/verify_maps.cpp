#include "validation/verify/verify_maps.h"

#include <cmath>

#include "core/procedural/smooth_math.h"

namespace etalon::validation {

std::shared_ptr<const Image> swirled_map(int width, int height) {
  auto map = std::make_shared<Image>(width, height, kRg32f);
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const double x = (i + 0.5) / width - 0.5;
      const double y = (j + 0.5) / height - 0.5;
      const double fall = 1 - 4 * (x * x + y * y);
      const double turns = fall > 0 ? 0.4 * fall * fall : 0;
      const double c = procedural::cos_turns(turns);
      const double s = procedural::sin_turns(turns);
      map->channels<float>(i, j)[0] = static_cast<float>(0.5 + c * x - s * y);
      map->channels<float>(i, j)[1] = static_cast<float>(0.5 + s * x + c * y);
    }
  }
  return map;
}

namespace {

// round((2k + 1)·65535 / 2n), half to even.
std::uint16_t unorm16_center(int k, int n) {
  const std::int64_t numerator = (2 * std::int64_t{k} + 1) * 65535;
  const std::int64_t denominator = 2 * std::int64_t{n};
  std::int64_t quotient = numerator / denominator;
  const std::int64_t twice_rest = 2 * (numerator % denominator);
  if (twice_rest > denominator || (twice_rest == denominator && quotient % 2 != 0)) ++quotient;
  return static_cast<std::uint16_t>(quotient);
}

}  // namespace

std::shared_ptr<const Image> identity_map(int width, int height) {
  auto map = std::make_shared<Image>(width, height, PixelFormat{ChannelType::unorm16, 2});
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      map->channels<std::uint16_t>(i, j)[0] = unorm16_center(i, width);
      map->channels<std::uint16_t>(i, j)[1] = unorm16_center(j, height);
    }
  }
  return map;
}

std::shared_ptr<const Image> checkerboard() {
  constexpr int kSize = 256;
  auto image = std::make_shared<Image>(kSize, kSize, kRgb8);
  for (int j = 0; j < kSize; ++j) {
    for (int i = 0; i < kSize; ++i) {
      const bool light = ((i / 16) + (j / 16)) % 2 == 0;
      auto* rgb = image->channels<std::uint8_t>(i, j);
      rgb[0] = static_cast<std::uint8_t>(light ? 235 - i / 8 : 60 + i / 2);
      rgb[1] = static_cast<std::uint8_t>(light ? 228 : 70);
      rgb[2] = static_cast<std::uint8_t>(light ? 235 - j / 8 : 60 + j / 2);
    }
  }
  return image;
}

}  // namespace etalon::validation
