#include "validation/verify/verify_maps.h"

#include <doctest/doctest.h>

using namespace etalon;
using namespace etalon::validation;

TEST_CASE("the identity map names every texel by nearest lookup") {
  for (const int size : {1, 2, 3, 100, 1024, 8192}) {
    const auto map = identity_map(size, 1);
    int wrong = 0;
    for (int i = 0; i < size; ++i) {
      // floor(stored/65535 · size) in integers.
      if (std::int64_t{map->channels<std::uint16_t>(i, 0)[0]} * size / 65535 != i) ++wrong;
    }
    CAPTURE(size);
    CHECK(wrong == 0);
  }
  CHECK(identity_map(1, 1)->channels<std::uint16_t>(0, 0)[0] == 32768);  // 32767.5, to even
}

TEST_CASE("the swirled map turns about the centre, stays inside, and leaves the corners alone") {
  const auto map = swirled_map(65, 65);
  CHECK(map->channels<float>(32, 32)[0] == 0.5f);
  CHECK(map->channels<float>(32, 32)[1] == 0.5f);
  CHECK(map->channels<float>(0, 0)[0] == static_cast<float>(0.5 / 65 - 0.5 + 0.5));
  for (int j = 0; j < 65; ++j) {
    for (int i = 0; i < 65; ++i) {
      const float* uv = map->channels<float>(i, j);
      REQUIRE((uv[0] > 0 && uv[0] < 1 && uv[1] > 0 && uv[1] < 1));
    }
  }
}

TEST_CASE("the checkerboard tells left from right and up from down") {
  const auto image = checkerboard();
  CHECK(*image != flipped_rows(*image));
  CHECK(image->texel(0, 0)[0] != image->texel(255, 255)[0]);
  CHECK(image->channels<std::uint8_t>(0, 0)[0] != image->channels<std::uint8_t>(16, 0)[0]);
}
