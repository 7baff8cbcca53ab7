// Images: layout, limits, identity.
#include "core/image/image.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "core/base/error.h"

using namespace etalon;

TEST_CASE("image: the empty one") {
  const Image none;
  CHECK(none.empty());
  CHECK(none.texel_count() == 0);
  CHECK(none.bytes().empty());
  CHECK(flipped_rows(none) == none);
}

TEST_CASE("image: starts as zeros, tightly packed, row by row") {
  Image image(3, 2, kRgb8);
  CHECK(image.bytes().size() == 18);
  CHECK(std::ranges::all_of(image.bytes(), [](std::byte b) { return b == std::byte{0}; }));
  image.channels<std::uint8_t>(2, 1)[1] = 77;
  CHECK(image.bytes()[(1 * 3 + 2) * 3 + 1] == std::byte{77});
  CHECK(image.texel(0, 1) - image.texel(0, 0) == 9);
}

TEST_CASE("image: a float32 channel reads back as written") {
  Image image(5, 4, kRg32f);
  image.channels<float>(4, 3)[1] = -2.5f;
  CHECK(image.channels<float>(4, 3)[1] == -2.5f);
  CHECK(image.bytes().size() == 5 * 4 * 8);
}

TEST_CASE("image: sizes and channels out of range are refused, by name") {
  CHECK_THROWS_WITH_AS(Image(0, 1, kRgba8), "image size: expected 1x1 to 32768x32768, got 0x1", InputError);
  CHECK_THROWS_WITH_AS(Image(1, -1, kRgba8), "image size: expected 1x1 to 32768x32768, got 1x-1", InputError);
  CHECK_THROWS_WITH_AS(Image(32769, 1, kRgba8), "image size: expected 1x1 to 32768x32768, got 32769x1", InputError);
  CHECK_THROWS_WITH_AS(Image(1, 1, {ChannelType::unorm8, 0}), "image channels: expected 1 to 4, got 0", InputError);
  CHECK_THROWS_WITH_AS(Image(1, 1, {ChannelType::unorm8, 5}), "image channels: expected 1 to 4, got 5", InputError);
  CHECK_NOTHROW(Image(kMaxImageSize, 1, kR32ui));
}

TEST_CASE("image: flipping reverses the rows, not the columns, and twice is the identity") {
  Image image(2, 3, kRgba8);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 2; ++x) image.channels<std::uint8_t>(x, y)[0] = static_cast<std::uint8_t>(10 * y + x);
  const Image flipped = flipped_rows(image);
  CHECK(flipped.channels<std::uint8_t>(0, 0)[0] == 20);
  CHECK(flipped.channels<std::uint8_t>(1, 0)[0] == 21);
  CHECK(flipped.channels<std::uint8_t>(1, 1)[0] == 11);
  CHECK(flipped.channels<std::uint8_t>(0, 2)[0] == 0);
  CHECK(flipped_rows(flipped) == image);
}

TEST_CASE("image: equality and sha256 see format, size and every byte") {
  const Image image(4, 2, kRgba8);
  CHECK(image == Image(4, 2, kRgba8));
  CHECK(image.sha256() == Image(4, 2, kRgba8).sha256());

  Image other = image;
  other.bytes().back() = std::byte{1};
  const Image cases[] = {other, Image(2, 4, kRgba8), Image(4, 2, {ChannelType::srgb8, 4}), Image(8, 2, {ChannelType::unorm8, 2}), Image()};
  for (const Image& different : cases) {
    CHECK(!(different == image));
  }
  for (const Image& different : {cases[0], cases[1], cases[2], cases[3]}) CHECK(different.sha256() != image.sha256());
}

TEST_CASE("image: the hash is golden") {
  Image image(2, 1, kRgba8);
  for (int i = 0; i < 8; ++i) image.bytes()[static_cast<std::size_t>(i)] = static_cast<std::byte>(i);
  // printf 'etalon/image/1 rgba unorm8 2 1\n\0\1\2\3\4\5\6\7' | sha256sum
  CHECK(image.sha256() == "7324485ab123cd4d098214f29603ca5b4118e591b76cb1b02302bdb0c20e4024");
}
