// Thresholds as idiff has them. Pictures of 16 texels, so that a percentage is a number of texels one can count.
#include "validation/metrics/pixel_comparison.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/rng.h"

namespace etalon::validation {
namespace {

// 4 × 4, every byte 100.
Image grey() {
  Image image(4, 4, kRgb8);
  for (std::byte& byte : image.bytes()) byte = std::byte{100};
  return image;
}

// Three texels differ: by 1, by 40 and by 10 of 255.
Image changed() {
  Image image = grey();
  image.channels<std::uint8_t>(1, 0)[2] = 101;
  image.channels<std::uint8_t>(2, 1)[2] = 140;
  image.channels<std::uint8_t>(3, 1)[0] = 90;
  return image;
}

PixelVerdict verdict(const PixelThresholds& thresholds) { return compare_pixels(grey(), changed(), thresholds).verdict; }

TEST_CASE("pixels: the figures, as idiff prints them for this pair") {
  const PixelComparison result = compare_pixels(grey(), changed(), {});
  CHECK(result.pixels == 16);
  CHECK(result.differing == 3);
  CHECK(result.fail.over == 3);
  CHECK(result.mean_error == doctest::Approx(0.00416667).epsilon(1e-5));  // (1 + 40 + 10) / 255 / 48
  CHECK(result.rms_error == doctest::Approx(0.0233449).epsilon(1e-5));
  REQUIRE(result.psnr_db);
  CHECK(*result.psnr_db == doctest::Approx(32.6362).epsilon(1e-5));
  CHECK(result.max_error == 140.0 / 255 - 100.0 / 255);
  CHECK(result.max_x == 2);
  CHECK(result.max_y == 1);
  CHECK(result.max_channel == 2);
  CHECK(result.max_relative == doctest::Approx(40.0 / 120));
  CHECK(result.verdict == PixelVerdict::failure);
}

TEST_CASE("pixels: identical pictures have no PSNR and need no threshold") {
  const PixelComparison result = compare_pixels(grey(), grey(), {.fail = {.absolute = 0}, .warn = {.absolute = 0}});
  CHECK(result.differing == 0);
  CHECK(!result.psnr_db);
  CHECK(result.max_error == 0);
  CHECK(result.max_x == -1);
  CHECK(result.verdict == PixelVerdict::pass);
  CHECK(result.passing.absolute == 0);
  CHECK(result.passing.percent == 0);
}

TEST_CASE("pixels: each threshold alone") {
  const PixelLimit nothing{.absolute = 1};
  CHECK(verdict({.fail = {.absolute = 0.004}, .warn = nothing}) == PixelVerdict::failure);
  CHECK(verdict({.fail = {.absolute = 0.157}, .warn = nothing}) == PixelVerdict::pass);
  CHECK(verdict({.fail = {.relative = 0.3}, .warn = nothing}) == PixelVerdict::failure);
  CHECK(verdict({.fail = {.relative = 0.34}, .warn = nothing}) == PixelVerdict::pass);
  CHECK(verdict({.fail = {.percent = 18.75}, .warn = nothing}) == PixelVerdict::pass);
  CHECK(verdict({.fail = {.percent = 18.74}, .warn = nothing}) == PixelVerdict::failure);
  CHECK(verdict({.fail = {.percent = 50, .hard = 0.1}, .warn = nothing}) == PixelVerdict::failure);
  CHECK(verdict({.fail = nothing, .warn = {.absolute = 0.004}}) == PixelVerdict::warning);
  CHECK(verdict({.fail = nothing, .warn = {.absolute = 1, .hard = 0.1}}) == PixelVerdict::warning);
  CHECK(verdict({.fail = {}, .warn = nothing, .allow_failures = 3}) == PixelVerdict::pass);
  CHECK(verdict({.fail = {}, .warn = nothing, .allow_failures = 2}) == PixelVerdict::failure);
  CHECK(verdict({.fail = {.hard = 0.1}, .warn = nothing, .allow_failures = 3}) == PixelVerdict::pass);
}

TEST_CASE("pixels: the smallest thresholds that pass do pass, and a smaller one does not") {
  Rng rng(3);
  for (int n = 0; n < 200; ++n) {
    Image a(7, 5, n % 2 == 0 ? kRgba8 : kRgba32f), b = a;
    for (Image* image : {&a, &b})
      for (int i = 0; i < 7 * 5 * 4; ++i) {
        if (image->format().type == ChannelType::unorm8)
          image->channels<std::uint8_t>(0, 0)[i] = static_cast<std::uint8_t>(rng.below(4));
        else
          image->channels<float>(0, 0)[i] = rng.below(3) == 0 ? 1 : static_cast<float>(rng.unit()) * 3;
      }
    const PixelLimit nothing{.absolute = 1e9};
    const PixelComparison result = compare_pixels(a, b, {.warn = nothing});
    const auto passes = [&](const PixelLimit& fail, std::uint64_t allowed) {
      return compare_pixels(a, b, {.fail = fail, .warn = nothing, .allow_failures = allowed}).verdict == PixelVerdict::pass;
    };
    REQUIRE((result.passing.absolute && result.passing.relative && result.passing.percent));
    const double less = 1 - 0x1p-40;
    CHECK(passes({.absolute = *result.passing.absolute}, 0));
    CHECK(!passes({.absolute = *result.passing.absolute * less}, 0));
    CHECK(passes({.relative = *result.passing.relative}, 0));
    CHECK(!passes({.relative = *result.passing.relative * less}, 0));
    CHECK(passes({.percent = *result.passing.percent}, 0));
    CHECK(!passes({.percent = *result.passing.percent * less}, 0));
    CHECK(passes({}, result.passing.allow_failures));
    CHECK(!passes({}, result.passing.allow_failures - 1));
  }
}

TEST_CASE("pixels: the smallest thresholds that pass, with every other threshold given too") {
  Rng rng(11);
  int by_hard = 0, by_none = 0, tolerant = 0;
  for (int n = 0; n < 2000; ++n) {
    Image a(5, 4, kRg32f), b = a;
    for (int i = 0; i < 5 * 4 * 2; ++i) {
      a.channels<float>(0, 0)[i] = static_cast<float>(rng.below(8)) / 4;
      b.channels<float>(0, 0)[i] = a.channels<float>(0, 0)[i] + (rng.below(4) == 0 ? static_cast<float>(rng.below(9)) / 8 - 0.5f : 0);
    }
    const PixelLimit nothing{.absolute = 1e9};
    PixelThresholds given{.fail = {.absolute = rng.below(2) * 0.2, .relative = rng.below(3) * 0.25, .percent = rng.below(3) * 9.0}};
    given.warn = nothing;
    if (rng.below(3) == 0) given.fail.hard = rng.below(5) * 0.1;
    given.allow_failures = rng.below(3);
    const PassingThresholds passing = compare_pixels(a, b, given).passing;
    const auto fails = [&](const auto& change) {
      PixelThresholds changed = given;
      change(changed);
      return compare_pixels(a, b, changed).verdict == PixelVerdict::failure;
    };
    const auto smallest = [&](const std::optional<double>& value, double PixelLimit::*limit) {
      const double tried = value.value_or(1e9), less = tried - std::max(tried, 1e-3) * 0x1p-40;
      CHECK(fails([&](PixelThresholds& t) { t.fail.*limit = tried; }) == !value);
      if (value && less >= 0) CHECK(fails([&](PixelThresholds& t) { t.fail.*limit = less; }));
    };
    smallest(passing.absolute, &PixelLimit::absolute);
    smallest(passing.relative, &PixelLimit::relative);
    smallest(passing.percent, &PixelLimit::percent);
    if (passing.hard) smallest(passing.hard, &PixelLimit::hard);
    CHECK(!fails([&](PixelThresholds& t) { t.allow_failures = passing.allow_failures; }));
    if (passing.allow_failures > 0) CHECK(fails([&](PixelThresholds& t) { t.allow_failures = passing.allow_failures - 1; }));
    by_hard += passing.hard ? 1 : 0;
    by_none += !passing.hard && !passing.absolute ? 1 : 0;
    tolerant += passing.absolute && *passing.absolute > 0 && given.fail.percent > 0 ? 1 : 0;
  }
  CHECK((by_hard > 50 && by_none > 50 && tolerant > 50));
}

TEST_CASE("pixels: formats may differ, what is missing is 0, and NaN equals NaN only") {
  Image bytes = grey(), words(4, 4, {ChannelType::unorm16, 3});
  for (int i = 0; i < 48; ++i) words.channels<std::uint16_t>(0, 0)[i] = 25700;  // 25700 / 65535 = 100 / 255
  CHECK(compare_pixels(bytes, words, {.fail = {.absolute = 0}}).differing == 0);
  Image with_alpha(4, 4, kRgba8);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      for (int c = 0; c < 4; ++c) with_alpha.channels<std::uint8_t>(x, y)[c] = c < 3 ? 100 : 255;
  const PixelComparison alpha = compare_pixels(bytes, with_alpha, {});
  CHECK(alpha.channels == 4);
  CHECK(alpha.max_error == 1);
  CHECK(alpha.max_channel == 3);
  Image nan(1, 1, kR32f), number(1, 1, kR32f);
  *nan.channels<float>(0, 0) = std::nanf("");
  CHECK(compare_pixels(nan, nan, {}).differing == 0);
  const PixelComparison one = compare_pixels(nan, number, {.fail = {.absolute = 1e300}, .warn = {.absolute = 1e300}});
  CHECK(std::isinf(one.max_error));
  CHECK(one.verdict == PixelVerdict::failure);
  CHECK(!one.passing.absolute);
  CHECK(one.passing.percent == 100);
  CHECK_THROWS_AS((void)compare_pixels(grey(), Image(4, 5, kRgb8), {}), InputError);
  CHECK_THROWS_AS((void)compare_pixels(grey(), Image(), {}), InputError);
}

TEST_CASE("pixels: the same figures for every number of threads") {
  Rng rng(5);
  Image a(301, 207, kRgba32f), b = a;
  for (int i = 0; i < 301 * 207 * 4; ++i) {
    a.channels<float>(0, 0)[i] = static_cast<float>(rng.unit());
    b.channels<float>(0, 0)[i] = static_cast<float>(rng.unit());
  }
  const PixelComparison first = compare_pixels(a, b, {});
  for (const int threads : {1, 2, 7}) {
    set_thread_count(threads);
    const PixelComparison again = compare_pixels(a, b, {});
    CHECK(again.mean_error == first.mean_error);
    CHECK(again.rms_error == first.rms_error);
    CHECK(again.max_x == first.max_x);
  }
  set_thread_count(0);
}

}  // namespace
}  // namespace etalon::validation
