#include <doctest/doctest.h>

#include "core/math/srgb.h"
#include "tests/raster/draw_helpers.h"

using namespace etalon;
using namespace etalon::test;

namespace {

// The stored first channel of a triangle of one constant colour.
template <class T>
T stored(float value, ChannelType type, HalfRounding rounding = HalfRounding::nearest_even) {
  std::vector<RasterVertex> vertices = {at(0, 0), at(2, 0), at(0, 2)};
  for (RasterVertex& v : vertices) v.color = {value, 0, 0, 1};
  Frame frame = frame_of(1, 1, {{TargetContent::color, {type, 4}}});
  frame.state.half_rounding = rounding;
  raster::CpuRenderer renderer;
  return renderer.render(list_of(vertices), frame)[0].channels<T>(0, 0)[0];
}

}  // namespace

TEST_CASE("unorm clamps and rounds to nearest") {
  CHECK(stored<std::uint8_t>(-3, ChannelType::unorm8) == 0);
  CHECK(stored<std::uint8_t>(1e9f, ChannelType::unorm8) == 255);
  CHECK(stored<std::uint8_t>(0.5f, ChannelType::unorm8) == 128);  // 127.5: to even
  CHECK(stored<std::uint16_t>(0.5f, ChannelType::unorm16) == 32768);
  CHECK(stored<std::uint8_t>(127.0f / 255, ChannelType::unorm8) == 127);
}

TEST_CASE("half rounds or truncates, and overflows as the state says") {
  CHECK(stored<std::uint16_t>(1 + 0x1p-11f, ChannelType::half) == 0x3C00);  // tie, even
  CHECK(stored<std::uint16_t>(1 + 0x3p-11f, ChannelType::half) == 0x3C02);  // tie, even above
  CHECK(stored<std::uint16_t>(1 + 0x1.8p-10f, ChannelType::half, HalfRounding::toward_zero) == 0x3C01);
  CHECK(stored<std::uint16_t>(65520, ChannelType::half) == 0x7C00);
  CHECK(stored<std::uint16_t>(65519, ChannelType::half) == 0x7BFF);
  CHECK(stored<std::uint16_t>(1e6f, ChannelType::half, HalfRounding::toward_zero) == 0x7BFF);
  CHECK(stored<std::uint16_t>(-0x1p-26f, ChannelType::half) == 0);  // rounds to zero: +0
}

TEST_CASE("float32 keeps a constant; noise below 2^-40 and minus zero enter as zero") {
  CHECK(stored<float>(0.1f, ChannelType::float32) == 0.1f);
  CHECK(stored<std::uint32_t>(-0.0f, ChannelType::float32) == 0);
  CHECK(stored<float>(0x1p-41f, ChannelType::float32) == 0);
  CHECK(stored<float>(-0x1p-40f, ChannelType::float32) == -0x1p-40f);
}

TEST_CASE("srgb8 encodes colours by the thresholds and leaves alpha linear") {
  CHECK(stored<std::uint8_t>(kSrgbThreshold[99], ChannelType::srgb8) == 100);
  CHECK(stored<std::uint8_t>(std::nextafter(kSrgbThreshold[99], 0.0f), ChannelType::srgb8) == 99);
  CHECK(stored<std::uint8_t>(2, ChannelType::srgb8) == 255);
  std::vector<RasterVertex> vertices = {at(0, 0), at(2, 0), at(0, 2)};
  for (RasterVertex& v : vertices) v.color = {0, 0, 0, 0.2f};
  raster::CpuRenderer renderer;
  const Image image = renderer.render(list_of(vertices), frame_of(1, 1, {{TargetContent::color, {ChannelType::srgb8, 4}}}))[0];
  CHECK(image.channels<std::uint8_t>(0, 0)[3] == 51);
}

TEST_CASE("clears go through the same storage") {
  raster::CpuRenderer renderer;
  const auto images = renderer.render(list_of({}), frame_of(2, 1,
                                                            {{TargetContent::color, kRgba8, {0.5f, 2, -1, 1}},
                                                             {TargetContent::triangle_id, kR32ui},
                                                             {TargetContent::depth, kR32f},
                                                             {TargetContent::margins, kRgba32f}}));
  CHECK(images[0].channels<std::uint8_t>(1, 0)[0] == 128);
  CHECK(images[0].channels<std::uint8_t>(1, 0)[1] == 255);
  CHECK(images[0].channels<std::uint8_t>(1, 0)[2] == 0);
  CHECK(images[1].channels<std::uint32_t>(1, 0)[0] == kNoTriangle);
  CHECK(images[2].channels<float>(0, 0)[0] == 1);
  CHECK(images[3].channels<float>(0, 0)[3] == 0);
}
