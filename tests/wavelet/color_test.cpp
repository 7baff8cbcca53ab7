#include "core/wavelet/color.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/error.h"
#include "tests/wavelet/sample_textures.h"

using namespace etalon;
using namespace etalon::wavelet;

namespace {

// All triples of some bytes, among them the extremes.
Image many_colours() {
  Image image(18 * 18, 18, kRgb8);
  const auto byte = [](int i) { return static_cast<std::uint8_t>(i == 17 ? 255 : 15 * i + i % 2); };
  for (int y = 0; y < 18; ++y)
    for (int x = 0; x < 18 * 18; ++x) {
      auto* texel = image.channels<std::uint8_t>(x, y);
      texel[0] = byte(x / 18);
      texel[1] = byte(x % 18);
      texel[2] = byte(y);
    }
  return image;
}

}  // namespace

TEST_CASE("colour: the reversible transform is") {
  const Image image = many_colours();
  const auto planes = reversible_planes(image);
  CHECK(reversible_image(planes, kRgb8) == image);
  // Texel (255, 0, 0): Y = ⌊255/4⌋ − 128 = −65, U = 0, V = 255.
  const std::size_t red = 17 * 18;
  CHECK(planes[0].values[red] == -65);
  CHECK(planes[1].values[red] == 0);
  CHECK(planes[2].values[red] == 255);
}

TEST_CASE("colour: the irreversible transform comes back to the same bytes") {
  const Image image = many_colours();
  CHECK(irreversible_image(irreversible_planes(image), kRgb8) == image);
}

TEST_CASE("colour: grey is only shifted") {
  const Image grey = test::noise_texture(9, 5, {ChannelType::unorm8, 1}, 1);
  CHECK(reversible_image(reversible_planes(grey), grey.format()) == grey);
  CHECK(irreversible_image(irreversible_planes(grey), grey.format()) == grey);
}

TEST_CASE("colour: what is out of range is clamped") {
  std::vector<Plane<std::int32_t>> wild(3, {1, 1});
  wild[0].values[0] = 2147483647;
  wild[1].values[0] = -2147483647 - 1;
  wild[2].values[0] = -2147483647 - 1;
  CHECK(reversible_image(wild, kRgb8).texel_count() == 1);
  std::vector<Plane<double>> bright(1, {2, 1});
  bright[0].values = {1e300, -1e300};
  const Image image = irreversible_image(bright, {ChannelType::unorm8, 1});
  CHECK(*image.channels<std::uint8_t>(0, 0) == 255);
  CHECK(*image.channels<std::uint8_t>(1, 0) == 0);
}

TEST_CASE("colour: the norms are those of the inverse transforms") {
  // By the inverse of a large unit: 64 in one channel changes bytes by 64 times its column, up to their rounding.
  for (int c = 0; c < 3; ++c) {
    std::vector<Plane<double>> planes(3, {1, 1});
    planes[static_cast<std::size_t>(c)].values[0] = 64;
    const Image image = irreversible_image(planes, kRgb8);
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double d = image.channels<std::uint8_t>(0, 0)[k] - 128.0;
      sum += d * d;
    }
    CHECK(std::abs(std::sqrt(sum) / 64 - channel_norm(c, 3, Kernel::irreversible_9_7)) < 3 * 0.5 / 64);
  }
  CHECK(channel_norm(0, 1, Kernel::reversible_5_3) == 1);
  CHECK(channel_norm(2, 3, Kernel::reversible_5_3) == doctest::Approx(std::sqrt(9.0 / 16 + 1.0 / 16 + 1.0 / 16)));
}

TEST_CASE("colour: other formats are refused") {
  CHECK_THROWS_WITH_AS((void)reversible_planes(Image(2, 2, kRgba8)), "texture: expected 1 or 3 channels of 8 bits, got rgba unorm8",
                       InputError);
  CHECK_THROWS_AS((void)irreversible_planes(Image(2, 2, kR32f)), InputError);
}
