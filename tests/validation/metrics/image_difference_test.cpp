#include "validation/metrics/image_difference.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/rng.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

template <class T>
Image literal(int width, int height, PixelFormat format, const std::vector<T>& values) {
  Image image(width, height, format);
  REQUIRE(values.size() * sizeof(T) == image.bytes().size());
  std::memcpy(image.bytes().data(), values.data(), image.bytes().size());
  return image;
}

constexpr PixelFormat kR8{ChannelType::unorm8, 1};
constexpr PixelFormat kRg8{ChannelType::unorm8, 2};
constexpr PixelFormat kR16{ChannelType::unorm16, 1};
constexpr PixelFormat kRHalf{ChannelType::half, 1};

}  // namespace

TEST_CASE("identical images: no PSNR, nothing differs") {
  const Image a = literal<std::uint8_t>(2, 2, kR8, {0, 1, 2, 255});
  const ImageDifference d = measure_difference(a, a);
  CHECK(d.identical);
  CHECK(d.texels == 4);
  CHECK(d.differing_texels == 0);
  CHECK(d.total.sse == 0);
  CHECK(d.total.max_abs == 0);
  CHECK(d.total.max_x == -1);
  CHECK(!d.psnr_db().has_value());
  CHECK(d.histogram == std::vector<HistogramBin>{{0, 0, 4}});
}

TEST_CASE("two channels of 8 bits, by hand") {
  //                                          (0,0)    (1,0)    (0,1)    (1,1)
  const Image a = literal<std::uint8_t>(2, 2, kRg8, {10, 20, /**/ 0, 255, /**/ 7, 7, /**/ 100, 0});
  const Image b = literal<std::uint8_t>(2, 2, kRg8, {13, 20, /**/ 255, 0, /**/ 7, 7, /**/ 97, 1});
  const ImageDifference d = measure_difference(a, b);
  CHECK(!d.identical);
  CHECK(d.differing_texels == 3);
  CHECK(d.channels[0].sse == 9 + 65025 + 0 + 9);
  CHECK(d.channels[1].sse == 0 + 65025 + 0 + 1);
  CHECK(d.total.sse == 130069);
  CHECK(d.mse() == 130069.0 / 8.0);
  CHECK(d.total.max_abs == 255);
  CHECK(d.total.max_x == 1);
  CHECK(d.total.max_y == 0);
  CHECK(d.total.differing == 5);
  CHECK(d.histogram == std::vector<HistogramBin>{{0, 0, 3}, {1, 1, 1}, {3, 3, 2}, {255, 255, 2}});
  // 10·log10(255²·8/130069) = 6.0201…
  CHECK(*d.psnr_db() == doctest::Approx(10 * std::log10(65025.0 * 8 / 130069)).epsilon(1e-5));
}

TEST_CASE("the first of several largest differences, in row order") {
  const Image a = literal<std::uint8_t>(3, 2, kR8, {0, 5, 0, 5, 0, 0});
  const Image b = literal<std::uint8_t>(3, 2, kR8, {0, 0, 5, 0, 0, 0});
  const ImageDifference d = measure_difference(a, b);
  CHECK(d.total.max_x == 1);
  CHECK(d.total.max_y == 0);
}

TEST_CASE("the mask leaves texels out") {
  const Image a = literal<std::uint8_t>(2, 2, kR8, {0, 0, 0, 0});
  const Image b = literal<std::uint8_t>(2, 2, kR8, {1, 2, 3, 4});
  const Image mask = literal<std::uint8_t>(2, 2, kR8, {255, 0, 1, 0});
  const ImageDifference d = measure_difference(a, b, &mask);
  CHECK(d.texels == 2);
  CHECK(d.differing_texels == 2);
  CHECK(d.total.sse == 1 + 9);
  CHECK(d.total.max_abs == 3);
  CHECK(d.samples() == 2);

  const Image none = literal<std::uint8_t>(2, 2, kR8, {0, 0, 0, 0});
  const ImageDifference nothing = measure_difference(a, b, &none);
  CHECK(nothing.texels == 0);
  CHECK(nothing.identical);
  CHECK(nothing.mse() == 0.0);
}

TEST_CASE("16 bits: the largest square stays exact") {
  const Image a = literal<std::uint16_t>(2, 1, kR16, {0, 40000});
  const Image b = literal<std::uint16_t>(2, 1, kR16, {65535, 40001});
  const ImageDifference d = measure_difference(a, b);
  CHECK(d.total.sse == 65535ull * 65535ull + 1);
  CHECK(d.histogram == std::vector<HistogramBin>{{1, 1, 1}, {65535, 65535, 1}});
}

TEST_CASE("float32: bits decide what is identical, ulp make the histogram, non-finite values stay out of sums") {
  const float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float next = std::nextafter(1.0f, 2.0f);
  const Image a = literal<float>(6, 1, kR32f, {1.0f, 1.0f, inf, nan, 0.0f, 0.25f});
  const Image b = literal<float>(6, 1, kR32f, {1.0f, next, 2.0f, nan, -0.0f, 0.75f});
  const ImageDifference d = measure_difference(a, b);
  CHECK(d.differing_texels == 4);
  CHECK(d.total.non_finite == 1);  // inf against 2; equal NaN bits are equal
  const double ulp = 0x1p-23;
  CHECK(d.total.squared_error == ulp * ulp + 0.25);
  CHECK(d.total.max_abs == 0.5);
  CHECK(d.total.max_x == 5);
  // 0.25 → 0.75: one binade (2^23) and half of the next (2^22): 12582912, in the bin that starts at 2^23. −0 against +0 is 0 ulp apart.
  CHECK(d.histogram == std::vector<HistogramBin>{{0, 0, 3}, {1, 1, 1}, {8388608, 16777215, 1}});
}

TEST_CASE("half bit patterns mean what binary16 says") {
  CHECK(half_value(0x0000) == 0.0);
  CHECK(half_value(0x0001) == 0x1p-24);
  CHECK(half_value(0x03FF) == 1023 * 0x1p-24);
  CHECK(half_value(0x0400) == 0x1p-14);
  CHECK(half_value(0x3C00) == 1.0);
  CHECK(half_value(0xC000) == -2.0);
  CHECK(half_value(0x7BFF) == 65504.0);
  CHECK(half_value(0x7C00) == std::numeric_limits<double>::infinity());
  CHECK(std::isnan(half_value(0x7C01)));
  const Image a = literal<std::uint16_t>(1, 1, kRHalf, {0x3C00});
  const Image b = literal<std::uint16_t>(1, 1, kRHalf, {0x3BFF});
  CHECK(measure_difference(a, b).total.max_abs == 0x1p-11);
}

TEST_CASE("ids are equal or different, never near") {
  const Image a = literal<std::uint32_t>(3, 1, kR32ui, {1, 5, 0xFFFFFFFFu});
  const Image b = literal<std::uint32_t>(3, 1, kR32ui, {1, 6, 0});
  const ImageDifference d = measure_difference(a, b);
  CHECK(d.differing_texels == 2);
  CHECK(d.histogram == std::vector<HistogramBin>{{0, 0, 1}, {1, 1, 2}});
  CHECK(!d.psnr_db().has_value());
}

TEST_CASE("the same doubles for 1, 2 and 7 threads") {
  Rng rng(3);
  Image a(97, 61, kRgba32f);
  Image b(97, 61, kRgba32f);
  for (int y = 0; y < 61; ++y) {
    for (int x = 0; x < 97; ++x) {
      for (int c = 0; c < 4; ++c) {
        a.channels<float>(x, y)[c] = rng.uniform(-1, 1);
        b.channels<float>(x, y)[c] = rng.uniform(-1, 1);
      }
    }
  }
  set_thread_count(1);
  const double one = measure_difference(a, b).total.squared_error;
  for (const int threads : {2, 7}) {
    set_thread_count(threads);
    CHECK(measure_difference(a, b).total.squared_error == one);
  }
  set_thread_count(0);
}

TEST_CASE("what cannot be compared is refused") {
  const Image a(2, 2, kR8);
  CHECK_THROWS_AS((void)measure_difference(a, Image(2, 3, kR8)), InputError);
  CHECK_THROWS_AS((void)measure_difference(a, Image(2, 2, kRg8)), InputError);
  CHECK_THROWS_AS((void)measure_difference(a, Image()), InputError);
  const Image small(1, 2, kR8);
  CHECK_THROWS_AS((void)measure_difference(a, a, &small), InputError);
  const Image wide(2, 2, kRg8);
  CHECK_THROWS_AS((void)measure_difference(a, a, &wide), InputError);
}
