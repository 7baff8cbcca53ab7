// Formats: sizes and names.
#include "core/image/pixel_format.h"

#include <doctest/doctest.h>

using etalon::ChannelType;
using etalon::PixelFormat;

TEST_CASE("pixel format: bytes per texel") {
  struct Row {
    ChannelType type;
    int bytes;
  };
  for (const auto& [type, bytes] : {Row{ChannelType::unorm8, 1}, Row{ChannelType::srgb8, 1}, Row{ChannelType::unorm16, 2},
                                    Row{ChannelType::half, 2}, Row{ChannelType::float32, 4}, Row{ChannelType::uint32, 4}}) {
    CHECK(etalon::bytes_per_channel(type) == bytes);
    for (int channels = 1; channels <= 4; ++channels) CHECK(etalon::bytes_per_texel({type, channels}) == bytes * channels);
  }
}

TEST_CASE("pixel format: names for people") {
  CHECK(to_string(etalon::kRgba8) == "rgba unorm8");
  CHECK(to_string(etalon::kRgb8) == "rgb unorm8");
  CHECK(to_string(etalon::kRg32f) == "rg float32");
  CHECK(to_string(etalon::kR32ui) == "r uint32");
  CHECK(to_string(PixelFormat{ChannelType::srgb8, 3}) == "rgb srgb8");
  CHECK(to_string(PixelFormat{ChannelType::unorm16, 1}) == "r unorm16");
  CHECK(to_string(PixelFormat{ChannelType::half, 4}) == "rgba half");
}
