#include "core/wavelet/texture_stream.h"

#include <doctest/doctest.h>

#include <array>
#include <limits>
#include <string>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/sha256.h"
#include "core/wavelet/encode_plan.h"
#include "core/wavelet/prefix_decoder.h"
#include "core/wavelet/reconstruct.h"
#include "tests/wavelet/sample_textures.h"

using namespace etalon;
using namespace etalon::wavelet;
using test::landscape_texture;
using test::noise_texture;
using test::squared_error;

namespace {

constexpr std::array kKernels = {Kernel::reversible_5_3, Kernel::irreversible_9_7};

std::string sha256_of(std::span<const std::byte> bytes) {
  Sha256 hash;
  hash.update(bytes);
  return hash.hex();
}

// An encoder's Coder that writes nothing and stops after some bits.
struct Stops {
  std::size_t left;
  struct End {};
  bool code(bool truth, AdaptiveBit&) {
    if (left == 0) throw End{};
    --left;
    return truth;
  }
  void on_significant() {}
};

// A decoder's that counts the bits that follow from a prefix.
struct Counts {
  PrefixDecoder decoder;
  std::size_t bits = 0;
  bool code(bool, AdaptiveBit& context) {
    if (!decoder.is_determined(context.probability())) throw Stops::End{};
    const bool bit = decoder.decode(context.probability());
    context.learn(bit);
    ++bits;
    return bit;
  }
  void on_significant() {}
};

}  // namespace

TEST_CASE("texture stream: 5/3 is lossless at every size") {
  for (const PixelFormat format : {kRgb8, PixelFormat{ChannelType::unorm8, 1}, PixelFormat{ChannelType::srgb8, 3}}) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 2}, {2, 1}, {3, 3}, {1, 40}, {17, 9}, {64, 64}, {75, 33}}) {
      const Image image = noise_texture(width, height, format, 3);
      const EncodedTexture encoded = encode_texture(image);
      CHECK(encoded.is_complete);
      const DecodedTexture decoded = decode_texture(encoded.bytes);
      CHECK(decoded.is_complete);
      CHECK(decoded.image == image);
      CHECK(decoded.significant == encoded.significant_total);
    }
  }
  const Image grey(20, 20, kRgb8);  // black: one coefficient a band at most
  CHECK(decode_texture(encode_texture(grey).bytes).image == grey);
}

TEST_CASE("texture stream: 9/7 comes within its quantisation, and closer with a finer step") {
  const Image image = landscape_texture(96, 80);
  std::uint64_t before = ~std::uint64_t{0};
  for (const int exponent : {3, 1, -1, -3}) {
    const EncodedTexture encoded = encode_texture(image, {.kernel = Kernel::irreversible_9_7, .step_exponent = exponent});
    const std::uint64_t error = squared_error(decode_texture(encoded.bytes).image, image);
    CHECK(error < before);
    before = error;
  }
  CHECK(before == 0);  // a step of 1/8 leaves less than half a byte everywhere
}

TEST_CASE("texture stream: every prefix is a picture, and more bytes are a better one") {
  const Image image = landscape_texture(48, 40);
  for (const Kernel kernel : kKernels) {
    const EncodedTexture encoded = encode_texture(image, {.kernel = kernel});
    const std::size_t header = read_texture_header(encoded.bytes).bytes;
    std::vector<std::size_t> prefixes;
    for (std::size_t n = header; n <= encoded.bytes.size(); ++n) prefixes.push_back(n);
    std::vector<std::uint64_t> errors;
    decode_prefixes(encoded.bytes, prefixes, {}, [&](std::size_t i, const DecodedTexture& decoded) {
      REQUIRE(i == errors.size());
      errors.push_back(squared_error(decoded.image, image));
      // In one go or alone: the same. (All of them in a tenth of the time that alone takes.)
      if (i % 7 == 0 || i + 40 > prefixes.size()) {
        const DecodedTexture alone = decode_texture(std::span(encoded.bytes).first(prefixes[i]));
        REQUIRE(alone.image == decoded.image);
        REQUIRE(alone.significant == decoded.significant);
        REQUIRE(alone.is_complete == decoded.is_complete);
      }
    });
    REQUIRE(errors.size() == prefixes.size());
    CHECK(errors.back() <= (kernel == Kernel::reversible_5_3 ? 0u : 200u));
    // Not monotone byte by byte (a found coefficient can be on the other side of a byte's rounding), but over each sixteenth of the stream.
    for (std::size_t k = 1; k <= 16; ++k) CHECK(errors[(errors.size() - 1) * k / 16] < errors[(errors.size() - 1) * (k - 1) / 16]);
  }
}

TEST_CASE("texture stream: the encoder's reconstruction of each point is the decoder's, byte for byte") {
  const Image image = landscape_texture(90, 61);
  for (const Kernel kernel : kKernels) {
    EncodeOptions options{.kernel = kernel};
    for (int i = 1; i <= 20; ++i) options.significant_shares.push_back(i / 20.0);
    const EncodedTexture encoded = encode_texture(image, options);
    REQUIRE(encoded.points.size() == 20);
    const EncodePlan plan = plan_encoding(image, options);
    for (std::size_t j = 0; j < encoded.points.size(); ++j) {
      const auto prefix = std::span(encoded.bytes).first(encoded.points[j].bytes);
      const std::size_t header = read_texture_header(prefix).bytes;
      // How many bits the prefix holds; then the encoder's own knowledge after as many.
      const std::vector<BandTruth> no_truths;
      Counts counts{PrefixDecoder(prefix.subspan(header), prefix.size() - header)};
      std::vector<BandState> states = plan_encoding(image, options).states;
      try {
        PlaneCoder(states, no_truths, counts).run(plan.passes);
      } catch (const Stops::End&) {
      }
      std::vector<BandState> own = plan_encoding(image, options).states;
      Stops stops{counts.bits};
      try {
        PlaneCoder(own, plan.truths, stops).run(plan.passes);
      } catch (const Stops::End&) {
      }
      const DecodedTexture decoded = decode_texture(prefix);
      CHECK(reconstruct(plan.header, own) == decoded.image);
      CHECK(decoded.significant >= encoded.points[j].significant);
      CHECK(encoded.points[j].significant >=
            static_cast<std::size_t>(options.significant_shares[j] * static_cast<double>(encoded.significant_total)));
      // One byte fewer tells fewer.
      CHECK(decode_texture(prefix.first(prefix.size() - 1)).significant < encoded.points[j].significant);
    }
    CHECK(encoded.points.back().significant == encoded.significant_total);
  }
}

TEST_CASE("texture stream: it can end at its last point or at a number of bytes, being a prefix of the whole one") {
  const Image image = landscape_texture(128, 128);
  const std::vector<double> shares = {0.001, 0.01, 0.1};
  const EncodedTexture whole = encode_texture(image, {.significant_shares = shares});
  const EncodedTexture cut = encode_texture(image, {.significant_shares = shares, .stops_at_last_share = true});
  CHECK_FALSE(cut.is_complete);
  REQUIRE(cut.bytes.size() == whole.points.back().bytes);
  CHECK(std::equal(cut.bytes.begin(), cut.bytes.end(), whole.bytes.begin()));
  REQUIRE(cut.points.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(cut.points[i].bytes == whole.points[i].bytes);
    CHECK(cut.points[i].significant == whole.points[i].significant);
  }
  for (const std::size_t limit : {std::size_t{15}, std::size_t{16}, std::size_t{700}}) {
    const EncodedTexture limited = encode_texture(image, {.significant_shares = shares, .max_bytes = limit});
    REQUIRE(limited.bytes.size() == limit);
    CHECK(std::equal(limited.bytes.begin(), limited.bytes.end(), whole.bytes.begin()));
    CHECK(limited.points.size() <= 2);
  }
}

TEST_CASE("texture stream: the same bytes and pictures for every number of threads, and from version to version") {
  const Image image = landscape_texture(200, 120);
  const std::array<std::string, 2> streams = {"36e27b69c813aa6a7c1f018a193cf00811b7a6ce479945bfe689bf0f80fca1b9",
                                              "e95b776ed42bfc15ef9a9c19c1d52eddf10d4190a3f44aa00d259a6577026c87"},
                                   pictures = {"e4698983b40689233c08d11204473e9483080d7729d9b1ab080b566891d876a0",
                                               "22aa6cdbe3ca0aac1e666328be0c3261c82d3a99cecb58cda3d479e9530a7fcd"};
  for (std::size_t k = 0; k < 2; ++k) {
    for (const int threads : {1, 2, 7}) {
      set_thread_count(threads);
      const EncodedTexture encoded = encode_texture(image, {.kernel = kKernels[k]});
      CHECK(sha256_of(encoded.bytes) == streams[k]);
      CHECK(decode_texture(std::span(encoded.bytes).first(1000)).image.sha256() == pictures[k]);
    }
  }
  set_thread_count(0);
}

TEST_CASE("texture stream: what cannot be encoded is refused") {
  const Image image = landscape_texture(16, 16);
  CHECK_THROWS_WITH_AS((void)encode_texture(Image()), "texture stream: expected an image, got an empty one", InputError);
  CHECK_THROWS_AS((void)encode_texture(Image(4, 4, kRgba8)), InputError);
  CHECK_THROWS_WITH_AS((void)encode_texture(image, {.levels = 13}), "texture stream: expected 1 to 12 levels, got 13", InputError);
  CHECK_THROWS_AS((void)encode_texture(image, {.kernel = Kernel::irreversible_9_7, .step_exponent = 7}), InputError);
  for (const std::vector<double>& shares : {std::vector{0.0}, {1.5}, {0.5, 0.25}, {std::numeric_limits<double>::quiet_NaN()}})
    CHECK_THROWS_AS((void)encode_texture(image, {.significant_shares = shares}), InputError);
  CHECK_THROWS_AS((void)encode_texture(image, {.max_bytes = 3}), InputError);
  const Delays other = make_delays(8, 16, 1, [](const Subband&, int, int) { return 0; });
  CHECK_THROWS_AS((void)encode_texture(image, {.levels = 1, .delays = other}), InputError);
}

TEST_CASE("texture stream: prefixes out of order or out of the stream are refused") {
  const EncodedTexture encoded = encode_texture(landscape_texture(16, 16));
  const auto decode = [&](const std::vector<std::size_t>& prefixes) {
    decode_prefixes(encoded.bytes, prefixes, {}, [](std::size_t, const DecodedTexture&) {});
  };
  CHECK_NOTHROW(decode({}));
  CHECK_NOTHROW(decode({15, 15, encoded.bytes.size()}));
  CHECK_THROWS_AS(decode({14}), InputError);
  CHECK_THROWS_AS(decode({40, 39}), InputError);
  CHECK_THROWS_AS(decode({encoded.bytes.size() + 1}), InputError);
}
