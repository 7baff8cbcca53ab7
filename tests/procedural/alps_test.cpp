#include "core/procedural/alps.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"

using namespace etalon;
using namespace etalon::procedural;

TEST_CASE("alps: mountains, a level lake, and the same bytes for any number of threads") {
  set_thread_count(1);
  const Alps one = make_alps({.size = 129, .texture_size = 128});
  set_thread_count(3);
  const Alps three = make_alps({.size = 129, .texture_size = 128});
  set_thread_count(0);
  CHECK(one.dem == three.dem);
  CHECK(one.texture == three.texture);
  CHECK(one.spacing == 40);
  CHECK(one.dem.format() == kR32f);
  CHECK(one.texture.format() == kRgb8);
  CHECK(one.dem.sha256() == "c9cacfa41934c7b2a0e32dbdabb5643dfef9f407e4697c039e82877328971e0a");
  CHECK(one.texture.sha256() == "646982a25a1597f3cda22c8559a50e6882457c00bbd45d415904d580c02a21b7");

  std::vector<float> heights;
  for (int y = 0; y < 129; ++y)
    for (int x = 0; x < 129; ++x) heights.push_back(*one.dem.channels<float>(x, y));
  std::sort(heights.begin(), heights.end());
  CHECK(heights.front() > 1200);
  CHECK(heights.back() - heights.front() > 700);
  CHECK(heights.back() < 4000);
  // The lake: one height that many samples share.
  std::size_t most = 0, run = 0;
  for (std::size_t n = 1; n < heights.size(); ++n) {
    run = heights[n] == heights[n - 1] ? run + 1 : 0;
    most = std::max(most, run);
  }
  CHECK(most > 20);
}

TEST_CASE("alps: a finer grid is the same place, its samples among the finer ones") {
  const Alps coarse = make_alps({.size = 33, .texture_size = 64}), fine = make_alps({.size = 65, .texture_size = 64});
  for (int y = 0; y < 33; ++y)
    for (int x = 0; x < 33; ++x) CHECK(*coarse.dem.channels<float>(x, y) == *fine.dem.channels<float>(2 * x, 2 * y));
  CHECK(make_alps({.size = 33, .texture_size = 64, .seed = 2}).dem != coarse.dem);
}

TEST_CASE("alps: progress ends, and sizes that are none are refused") {
  int last = 0;
  (void)make_alps({.size = 33, .texture_size = 64, .progress = [&](int done, int total) {
                     CHECK(done >= last);
                     CHECK(total == 100);
                     last = done;
                   }});
  CHECK(last == 100);
  CHECK_THROWS_AS((void)make_alps({.size = 256}), InputError);
  CHECK_THROWS_AS((void)make_alps({.size = 17}), InputError);
  CHECK_THROWS_AS((void)make_alps({.texture_size = 32}), InputError);
  CHECK_THROWS_AS((void)make_alps({.texture_size = 9000}), InputError);
}
