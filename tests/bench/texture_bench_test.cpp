#include "tests/bench/texture_bench.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace etalon;
using namespace etalon::bench;

namespace {

Image ramp(int width, int height) {
  Image image(width, height, kRgb8);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) image.channels<std::uint8_t>(x, y)[c] = static_cast<std::uint8_t>(17 * x + 5 * y * c);
  return image;
}

}  // namespace

TEST_CASE("textures: a rival that is worse by a known amount, and with fewer bytes, which ours gets too") {
  // One byte of the rival's picture is off by 100; it claims 100 bytes.
  const Codec rival = [](const Image& image, wavelet::Kernel, std::size_t) {
    CodedPicture coded{.stream = std::vector<std::byte>(100), .picture = image, .encode_seconds = 4, .decode_seconds = 2};
    coded.picture.bytes()[0] ^= std::byte{64};
    return coded;
  };
  const TextureSceneResult result = measure_textures({.name = "texture-ramp", .title = "a ramp"}, ramp(64, 64), rival, 2);
  REQUIRE(result.rows.size() == 10);
  CHECK(result.rows[0].ours.bytes == 51);  // 0.1 bit a texel
  CHECK(result.rows[2].ours.bytes == 100);
  CHECK(result.rows[2].theirs.psnr == doctest::Approx(10 * std::log10(255.0 * 255 * 64 * 64 * 3 / 4096)));
  CHECK(result.rows[2].ours.psnr < result.rows[2].theirs.psnr);
  REQUIRE(result.figures.size() == 2);
  CHECK(result.figures[0].values.size() == 1);
  const std::string tables = texture_tables(texture_document({result}));
  CHECK(tables.find("| 9/7 | 0.5 | 100 |") != std::string::npos);
  CHECK(tables.find("| short |") != std::string::npos);
}

TEST_CASE("textures: without OpenJPEG ours alone, and the figures say why they are skipped") {
  const TextureSceneResult result = measure_textures({.name = "texture-ramp", .title = "a ramp"}, ramp(64, 64), {}, 1);
  CHECK(result.rows[9].ours.bytes <= 1024);
  const std::string tables = texture_tables(texture_document({result}));
  CHECK(tables.find("skipped: built without libopenjp2-7-dev") != std::string::npos);
}

TEST_CASE("textures: resampling keeps what it can") {
  const Image image = ramp(8, 6);
  CHECK(resampled(image, 8, 6) == image);
  const Image half = resampled(ramp(4, 1), 2, 1);  // between texels 0 and 1, and 2 and 3: 8.5 and 42.5, rounded up
  CHECK(half.channels<std::uint8_t>(0, 0)[0] == 9);
  CHECK(half.channels<std::uint8_t>(1, 0)[0] == 43);
  CHECK(columns(image, 2, 3).channels<std::uint8_t>(1, 4)[0] == 51);
  const Image no_alpha = resampled(Image(2, 2, kRgba8), 2, 2);
  CHECK(no_alpha.format() == kRgb8);
}
