#include "tests/wavelet/sample_textures.h"

#include <algorithm>

#include "core/base/rng.h"
#include "core/procedural/noise.h"

namespace etalon::test {

Image noise_texture(int width, int height, PixelFormat format, std::uint64_t seed) {
  Image image(width, height, format);
  Rng rng(seed);
  for (std::byte& b : image.bytes()) b = static_cast<std::byte>(rng.next() & 0xFF);
  return image;
}

Image landscape_texture(int width, int height, PixelFormat format) {
  Image image(width, height, format);
  const double scale = 6.0 / std::max(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double hill = procedural::fractal_noise({x * scale, y * scale, 0.5}, 6, 7);
      const bool is_lake = hill < -0.15;
      const double base[3] = {is_lake ? 40.0 : 110 + 90 * hill, is_lake ? 70.0 : 120 + 60 * hill, is_lake ? 120.0 : 80 + 110 * hill};
      for (int c = 0; c < format.channels; ++c)
        image.channels<std::uint8_t>(x, y)[c] = static_cast<std::uint8_t>(std::clamp(base[c], 0.0, 255.0));
    }
  }
  return image;
}

std::uint64_t squared_error(const Image& a, const Image& b) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < a.bytes().size(); ++i) {
    const int d = std::to_integer<int>(a.bytes()[i]) - std::to_integer<int>(b.bytes()[i]);
    sum += static_cast<std::uint64_t>(d * d);
  }
  return sum;
}

}  // namespace etalon::test
