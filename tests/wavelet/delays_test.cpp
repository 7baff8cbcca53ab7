#include "core/wavelet/delays.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "core/wavelet/texture_stream.h"
#include "tests/wavelet/sample_textures.h"

using namespace etalon;
using namespace etalon::wavelet;
using test::landscape_texture;
using test::squared_error;

namespace {

// The left third of the texture is seen, from near by on its left border and ever farther to the right.
TexelView left_third(int width, int height) {
  TexelView view{width, height, {}, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float scale = 3 * x < width ? 2.0f / static_cast<float>(1 + x) : 0.0f;
      view.pixels_per_texel.push_back(scale);
      view.covered_pixels.push_back(scale * scale);
    }
  }
  return view;
}

TexelView everything(int width, int height, float scale) {
  const std::vector<float> all(static_cast<std::size_t>(width * height), scale);
  return {width, height, all, all};
}

std::uint64_t squared_error_left(const Image& a, const Image& b, int columns) {
  std::uint64_t sum = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < columns; ++x)
      for (int c = 0; c < 3; ++c) {
        const int d = a.channels<std::uint8_t>(x, y)[c] - b.channels<std::uint8_t>(x, y)[c];
        sum += static_cast<std::uint64_t>(d * d);
      }
  return sum;
}

}  // namespace

TEST_CASE("delays: any delays give a stream that is lossless but for what is never sent") {
  const Image image = landscape_texture(70, 45);
  for (const int greatest : {0, 1, 5, 300}) {
    const Delays delays = make_delays(70, 45, 3, [&](const Subband& band, int x, int y) {
      // A pure function of the place, since the order of calls is open.
      Rng own(static_cast<std::uint64_t>((band.y0 + y) * 70 + band.x0 + x));
      return static_cast<int>(own.below(static_cast<std::uint64_t>(greatest) + 1));
    });
    const EncodedTexture encoded = encode_texture(image, {.levels = 3, .delays = delays});
    CHECK(encoded.is_complete);
    const DecodedTexture decoded = decode_texture(encoded.bytes, delays);
    CHECK(decoded.is_complete);
    CHECK(decoded.image == image);
    // Prefixes, with their wakings in the middle.
    for (std::size_t bytes = 19; bytes < encoded.bytes.size(); bytes += 97)
      CHECK_FALSE(decode_texture(std::span(encoded.bytes).first(bytes), delays).is_complete);
  }
  // Without the finest level's details, and only without them: the next coarser picture. Its coefficients are not counted either.
  const Delays coarse = make_delays(70, 45, 3, [](const Subband& band, int, int) -> int { return band.level == 1 ? kNeverSent : 0; });
  const EncodedTexture encoded = encode_texture(image, {.levels = 3, .delays = coarse});
  const DecodedTexture decoded = decode_texture(encoded.bytes, coarse);
  CHECK(decoded.is_complete);
  CHECK(decoded.significant == encoded.significant_total);
  CHECK(squared_error(decoded.image, image) > 0);
  // Nothing at all: a header, and one grey.
  const Delays none = make_delays(70, 45, 3, [](const Subband&, int, int) -> int { return kNeverSent; });
  const EncodedTexture nothing = encode_texture(image, {.levels = 3, .delays = none, .significant_shares = {0.5}});
  CHECK(nothing.significant_total == 0);
  CHECK(nothing.points.empty());
  CHECK(std::to_integer<int>(decode_texture(nothing.bytes, none).image.bytes()[0]) == 128);
}

TEST_CASE("delays: no delay at all changes the order of nothing but the header") {
  const Image image = landscape_texture(64, 64);
  const Delays zero = make_delays(64, 64, 3, [](const Subband&, int, int) { return 0; });
  const EncodedTexture with = encode_texture(image, {.levels = 3, .delays = zero}), without = encode_texture(image, {.levels = 3});
  REQUIRE(with.bytes.size() == without.bytes.size() + 4);
  CHECK(std::equal(with.bytes.begin() + 19, with.bytes.end(), without.bytes.begin() + 15));
}

TEST_CASE("delays: a stream is refused with others than its own") {
  const Image image = landscape_texture(32, 32);
  const Delays one = make_delays(32, 32, 2, [](const Subband&, int, int) { return 1; });
  const Delays two = make_delays(32, 32, 2, [](const Subband&, int x, int) { return x % 2; });
  const EncodedTexture encoded = encode_texture(image, {.levels = 2, .delays = one}), plain = encode_texture(image, {.levels = 2});
  CHECK_NOTHROW((void)decode_texture(encoded.bytes, one));
  CHECK_THROWS_AS((void)decode_texture(encoded.bytes, two), InputError);
  CHECK_THROWS_AS((void)decode_texture(encoded.bytes), InputError);
  CHECK_THROWS_AS((void)decode_texture(plain.bytes, one), InputError);
}

TEST_CASE("view delays: bits go where they are seen") {
  const int size = 96;
  const Image image = landscape_texture(size, size);
  const TexelView view = left_third(size, size);
  const Delays delays = view_delays(view, {.levels = 4});
  const EncodedTexture seen = encode_texture(image, {.levels = 4, .delays = delays}), whole = encode_texture(image, {.levels = 4});
  CHECK(seen.significant_total < whole.significant_total / 2);
  CHECK(seen.bytes.size() < whole.bytes.size() / 2);
  // The eight columns nearest to the viewer, of the same number of bytes: better, although the header is longer.
  for (const std::size_t bytes : {500u, 1000u, 1500u}) {
    const auto near_error = [&](const EncodedTexture& encoded, const Delays& with) {
      return squared_error_left(decode_texture(std::span(encoded.bytes).first(std::min(bytes, encoded.bytes.size())), with).image, image,
                                8);
    };
    CHECK(near_error(seen, delays) < near_error(whole, {}));
  }
}

TEST_CASE("view delays: weights in powers of two, resolvable waves, and nothing where nothing is seen") {
  TexelView view = everything(16, 16, 1);
  view.covered_pixels[0] = 64;  // sqrt(64/1) = 2^3
  const Delays delays = view_delays(view, {.levels = 1, .least_pixels = 2});
  CHECK(delays.at(0, 0) == 0);
  CHECK(delays.at(7, 7) == 3);
  CHECK(delays.at(8 + 7, 7) == 3);  // level 1: waves of two texels have two pixels
  CHECK(view_delays(view, {.levels = 1, .least_pixels = 2.5}).at(8 + 7, 7) == kNeverSent);
  CHECK(view_delays(view, {.levels = 1, .least_pixels = 2.5}).at(7, 7) == 3);
  CHECK(view_delays(everything(4, 4, 0), {.levels = 1}).at(0, 0) == kNeverSent);
}

TEST_CASE("view delays: bad numbers are refused") {
  TexelView view = everything(4, 4, 1);
  CHECK_THROWS_AS((void)view_delays(view, {.levels = 0}), InputError);
  view.covered_pixels[3] = -1;
  CHECK_THROWS_AS((void)view_delays(view, {.levels = 1}), InputError);
  view.covered_pixels[3] = std::numeric_limits<float>::infinity();
  CHECK_THROWS_AS((void)view_delays(view, {.levels = 1}), InputError);
  view.covered_pixels.pop_back();
  CHECK_THROWS_AS((void)view_delays(view, {.levels = 1}), InputError);
  CHECK_THROWS_AS((void)distance_pyramid(everything(4, 4, 1), {.levels = 1, .steps = 100}), InputError);
  CHECK_THROWS_AS((void)distance_pyramid(everything(4, 4, 1), {.levels = 1, .per_octave_num = 0}), InputError);
}

TEST_CASE("pyramid: coarser textures first, each complete before the next") {
  const int size = 64, levels = 4;
  const Image image = landscape_texture(size, size);
  // One distance for all: level l is resolvable at d_i where 2^l·(1/2) >= 2^(i/2), that is i <= 2(l − 1).
  const Pyramid pyramid =
      distance_pyramid(everything(size, size, 0.5f), {.levels = levels, .steps = 7, .per_octave_num = 2, .per_octave_den = 1});
  const auto at = [&](int level) { return pyramid.delays.at(size >> level, 0); };
  CHECK(at(1) > at(2));
  CHECK(at(2) > at(3));
  CHECK(at(3) > at(4));
  CHECK(pyramid.coefficients.front() == static_cast<std::size_t>(size * size));
  CHECK(pyramid.coefficients[1] == static_cast<std::size_t>(size * size / 4));  // without level 1
  CHECK(pyramid.coefficients.back() == static_cast<std::size_t>((size >> levels) * (size >> levels)));
  const EncodedTexture encoded = encode_texture(image, {.levels = levels, .delays = pyramid.delays});
  CHECK(decode_texture(encoded.bytes, pyramid.delays).image == image);

  // A prefix that reaches level l holds the levels above it to the last bit: the picture of the stream that never sends level l.
  for (const int level : {1, 2, 3}) {
    const Delays without = make_delays(size, size, levels, [&](const Subband& band, int, int) -> int {
      return band.orientation != Orientation::ll && band.level <= level ? kNeverSent : 0;
    });
    const Image coarse = decode_texture(encode_texture(image, {.levels = levels, .delays = without}).bytes, without).image;
    bool found = false;
    std::vector<std::size_t> prefixes;
    for (std::size_t n = 19; n <= encoded.bytes.size(); ++n) prefixes.push_back(n);
    decode_prefixes(encoded.bytes, prefixes, pyramid.delays,
                    [&](std::size_t, const DecodedTexture& decoded) { found |= decoded.image == coarse; });
    CHECK(found);
  }
}

TEST_CASE("pyramid: points of complete delays are whole levels, bit for bit") {
  const int size = 64, levels = 4;
  const Image image = landscape_texture(size, size);
  for (const Kernel kernel : {Kernel::reversible_5_3, Kernel::irreversible_9_7}) {
    const Pyramid pyramid =
        distance_pyramid(everything(size, size, 0.5f), {.levels = levels, .steps = 7, .per_octave_num = 2, .per_octave_den = 1});
    const std::vector<int> delays = {pyramid.delays.at(size >> 4, 0), pyramid.delays.at(size >> 3, 0), pyramid.delays.at(size >> 2, 0),
                                     pyramid.delays.at(size >> 1, 0)};
    const EncodedTexture encoded =
        encode_texture(image, {.kernel = kernel, .levels = levels, .delays = pyramid.delays, .complete_delays = delays});
    REQUIRE(encoded.points.size() == delays.size());
    CHECK(encoded.points.back().significant == encoded.significant_total);
    for (std::size_t n = 0; n < delays.size(); ++n) {
      const Delays without = make_delays(size, size, levels, [&](const Subband& band, int, int) -> int {
        return band.orientation != Orientation::ll && band.level < levels - static_cast<int>(n) ? kNeverSent : 0;
      });
      const EncodedTexture coarse = encode_texture(image, {.kernel = kernel, .levels = levels, .delays = without});
      const DecodedTexture decoded = decode_texture(std::span(encoded.bytes).first(encoded.points[n].bytes), pyramid.delays);
      CHECK(decoded.image == decode_texture(coarse.bytes, without).image);
      CHECK(decoded.significant == coarse.significant_total);
      if (n > 0) CHECK(encoded.points[n].bytes > encoded.points[n - 1].bytes);
      const DecodedTexture less = decode_texture(std::span(encoded.bytes).first(encoded.points[n].bytes - 1), pyramid.delays);
      CHECK(less.significant <= decoded.significant);  // a byte less lacks at least its last bit
    }
  }
  const auto refused = [&](const std::vector<double>& shares, const std::vector<int>& delays) {
    CHECK_THROWS_AS((void)encode_texture(image, {.significant_shares = shares, .complete_delays = delays}), InputError);
  };
  refused({0.5}, {0});
  refused({}, {-1});
  refused({}, {kMaxDelay + 1});
  const Delays late = make_delays(size, size, levels, [](const Subband& band, int, int) { return band.level == 1 ? 60 : 0; });
  CHECK_THROWS_AS((void)encode_texture(image, {.levels = levels, .delays = late, .complete_delays = {60, 0}}), InputError);
}

TEST_CASE("pyramid: powers of two by roots") {
  CHECK(power_of_two(0, 7) == 1);
  CHECK(power_of_two(21, 7) == 8);
  CHECK(std::abs(power_of_two(1, 2) - std::sqrt(2.0)) < 0x1p-48);
  CHECK(std::abs(power_of_two(7, 4) - 2 * std::sqrt(2 * std::sqrt(2.0))) < 0x1p-46);
  double product = 1;  // (2^(10/93))^93 = 2^10
  for (int i = 0; i < 93; ++i) product *= power_of_two(10, 93);
  CHECK(std::abs(product / 1024 - 1) < 0x1p-40);
  CHECK(std::abs(power_of_two(999, 1000) * power_of_two(1, 1000) - 2) < 0x1p-40);
}
