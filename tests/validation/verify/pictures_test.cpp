#include "validation/verify/pictures.h"

#include <array>

#include <doctest/doctest.h>

using namespace etalon;
using namespace etalon::validation;

namespace {

std::array<std::uint8_t, 3> rgb(const Image& picture, int x, int y) {
  const auto* p = picture.channels<std::uint8_t>(x, y);
  return {p[0], p[1], p[2]};
}

}  // namespace

TEST_CASE("a lone bad texel is marked over its neighbourhood, and the worse mark wins") {
  const Image picture(9, 9, kRgb8);
  Image classes(9, 9, {ChannelType::unorm8, 1});
  *classes.channels<std::uint8_t>(2, 4) = static_cast<std::uint8_t>(TexelClass::tie);
  *classes.channels<std::uint8_t>(4, 4) = static_cast<std::uint8_t>(TexelClass::unexplained);
  const Image marked = class_picture(picture, classes, 1);
  CHECK(rgb(marked, 1, 4) == class_color(TexelClass::tie));
  CHECK(rgb(marked, 2, 4) == class_color(TexelClass::tie));
  CHECK(rgb(marked, 3, 4) == class_color(TexelClass::unexplained));
  CHECK(rgb(marked, 5, 5) == class_color(TexelClass::unexplained));
  CHECK(rgb(marked, 6, 4) == rgb(marked, 8, 8));
}

TEST_CASE("a mark survives the reduction of its picture") {
  const Image picture(100, 100, kRgb8);
  for (const int at : {0, 13, 50, 97, 99}) {
    Image classes(100, 100, {ChannelType::unorm8, 1});
    *classes.channels<std::uint8_t>(at, at) = static_cast<std::uint8_t>(TexelClass::unexplained);
    const Image small = reduced(class_picture(picture, classes, 5), 20);
    REQUIRE(small.width() == 20);
    bool found = false;
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 20; ++x) found = found || rgb(small, x, y) == class_color(TexelClass::unexplained);
    }
    CAPTURE(at);
    CHECK(found);
  }
  CHECK(reduced(picture, 100) == picture);
}

TEST_CASE("errors: dark where equal, brighter where larger") {
  Image a(7, 1, {ChannelType::unorm8, 1});
  Image b = a;
  *b.channels<std::uint8_t>(1, 0) = 1;
  *b.channels<std::uint8_t>(5, 0) = 255;
  const Image map = error_picture(a, b, 0);
  CHECK(rgb(map, 0, 0) == rgb(map, 3, 0));
  CHECK(rgb(map, 1, 0)[0] > rgb(map, 0, 0)[0]);
  CHECK(rgb(map, 5, 0)[0] > rgb(map, 1, 0)[0]);
}

TEST_CASE("depth: the nearer the brighter, nothing drawn is the backdrop; ids: unlike colours") {
  Image depth(3, 1, kR32f);
  depth.channels<float>(0, 0)[0] = 0.25f;
  depth.channels<float>(1, 0)[0] = 0.75f;
  depth.channels<float>(2, 0)[0] = 1.0f;
  const ValueRange range = drawn_range(depth);
  CHECK(range.low == 0.25f);
  CHECK(range.high == 0.75f);
  const Image picture = picture_of(depth, range.low, range.high);
  CHECK(rgb(picture, 0, 0)[0] > rgb(picture, 1, 0)[0]);
  Image ids(3, 1, kR32ui);
  ids.channels<std::uint32_t>(1, 0)[0] = 1;
  ids.channels<std::uint32_t>(2, 0)[0] = 0xFFFFFFFFu;
  const Image id_picture = picture_of(ids);
  CHECK(rgb(id_picture, 0, 0) != rgb(id_picture, 1, 0));
  CHECK(rgb(id_picture, 2, 0) == rgb(picture, 2, 0));
  Image nothing(1, 1, kR32f);
  nothing.channels<float>(0, 0)[0] = 1.0f;
  CHECK(drawn_range(nothing).high == 1.0f);
}

TEST_CASE("a crop is centred, and grey beyond the frame") {
  Image picture(5, 5, kRgb8);
  picture.channels<std::uint8_t>(0, 0)[0] = 200;
  const Image cut = crop(picture, 0, 0, 3);
  CHECK(rgb(cut, 1, 1)[0] == 200);
  CHECK(rgb(cut, 0, 0)[0] == 128);
  CHECK(rgb(cut, 2, 2)[0] == 0);
}
