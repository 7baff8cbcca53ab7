#include "core/procedural/test_images.h"

#include <algorithm>
#include <cstdint>

namespace etalon::procedural {

namespace {

constexpr int kSquare = 8;

std::uint8_t ramp_byte(int i, int size) {
  const int last = std::max(size - 1, 1);
  return static_cast<std::uint8_t>((2 * 255 * i + last) / (2 * last));  // round half up
}

}  // namespace

Image make_chessboard(int width, int height) {
  Image image(width, height, kRgb8);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      std::fill_n(image.channels<std::uint8_t>(x, y), 3, (x / kSquare + y / kSquare) % 2 == 0 ? std::uint8_t{0} : std::uint8_t{255});
  return image;
}

Image make_ramp(int width, int height) {
  Image image(width, height, kRgb8);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      auto* texel = image.channels<std::uint8_t>(x, y);
      texel[0] = ramp_byte(x, width);
      texel[1] = ramp_byte(y, height);
    }
  return image;
}

}  // namespace etalon::procedural
