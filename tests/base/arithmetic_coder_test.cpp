// The coder's bytes are golden: streams written with it are read for ever.
#include "core/base/arithmetic_coder.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <limits>
#include <vector>

#include "core/base/rng.h"
#include "core/base/sha256.h"

using namespace etalon;

namespace {

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text.data(), text.size())); }

std::vector<bool> biased_bits(std::size_t count, std::uint64_t ones_of_256, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<bool> bits(count);
  for (std::size_t i = 0; i < count; ++i) bits[i] = rng.below(256) < ones_of_256;
  return bits;
}

std::string coded(const std::vector<bool>& bits) {
  ArithmeticEncoder out;
  AdaptiveBit context;
  for (const bool bit : bits) out.encode(bit, context);
  return out.finish();
}

}  // namespace

TEST_CASE("arithmetic coder: nothing coded is no bytes; a decoder of no bytes says zeros for ever") {
  ArithmeticEncoder out;
  CHECK(out.finish().empty());
  ArithmeticDecoder in({});
  CHECK(in.at_end());
  CHECK_FALSE(in.exhausted());
  for (int i = 0; i < 100; ++i) CHECK(in.decode(32768));  // value 0 is always in the lower half
  CHECK(in.exhausted());
}

TEST_CASE("arithmetic coder: what went in comes out, for every length, and ends where the data end") {
  for (const std::uint64_t ones : {0u, 3u, 128u, 250u, 256u}) {
    for (std::size_t count = 0; count < 70; ++count) {
      const std::vector<bool> bits = biased_bits(count, ones, 7 + count);
      const std::string bytes = coded(bits);
      ArithmeticDecoder in(bytes_of(bytes));
      AdaptiveBit context;
      for (const bool bit : bits) REQUIRE(in.decode(context) == bit);
      CHECK(in.at_end());
    }
  }
}

TEST_CASE("arithmetic coder: fixed probabilities at both limits, in chance order") {
  Rng rng(11);
  std::vector<std::pair<bool, std::uint32_t>> symbols;
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t kind = rng.below(4);
    const std::uint32_t p = kind == 0 ? 1u : (kind == 1 ? 65535u : static_cast<std::uint32_t>(1 + rng.below(65535)));
    const bool bit = rng.coin();
    symbols.emplace_back(bit, p);
  }
  ArithmeticEncoder out;
  for (const auto& [bit, p] : symbols) out.encode(bit, p);
  const std::string bytes = out.finish();
  ArithmeticDecoder in(bytes_of(bytes));
  for (const auto& [bit, p] : symbols) REQUIRE(in.decode(p) == bit);
  CHECK(in.at_end());
}

TEST_CASE("arithmetic coder: one context comes near the entropy of its source") {
  // H(25/256) = 0.4615 bit: 200,000 bits are 11,538 bytes. The estimate's own noise costs a few per cent (rates 1/16 and 1/128).
  const std::size_t size = coded(biased_bits(200000, 25, 3)).size();
  CHECK(size > 11300);
  CHECK(size < 11538 * 1.03);
  // Even bits cost one bit each but for the estimate's noise; a constant source costs next to nothing: -log2(65504/65536) bit a bit.
  CHECK(coded(biased_bits(80000, 128, 4)).size() < 10000 * 1.02);
  CHECK(coded(biased_bits(80000, 0, 5)).size() < 20);
}

TEST_CASE("arithmetic coder: even bits take their room and no more") {
  ArithmeticEncoder out;
  Rng rng(6);
  std::vector<std::uint32_t> words;
  for (int i = 0; i < 1000; ++i) words.push_back(static_cast<std::uint32_t>(rng.next()));
  for (const std::uint32_t word : words) out.encode_even(word, 32);
  out.encode_even(5, 3);
  out.encode_even(0, 0);
  const std::string bytes = out.finish();
  CHECK(bytes.size() <= 4003);
  ArithmeticDecoder in(bytes_of(bytes));
  for (const std::uint32_t word : words) REQUIRE(in.decode_even(32) == word);
  CHECK(in.decode_even(3) == 5);
  CHECK(in.decode_even(0) == 0);
}

TEST_CASE("arithmetic coder: a cut stream decodes its beginning; where bits cost bytes, it then says that it is exhausted") {
  const std::vector<bool> bits = biased_bits(4000, 128, 8);
  ArithmeticEncoder out;
  for (const bool bit : bits) out.encode(bit, 32768);
  const std::string bytes = out.finish();
  CHECK(bytes.size() <= 501);
  for (const std::size_t kept : {std::size_t{0}, std::size_t{1}, std::size_t{250}, bytes.size() - 3, bytes.size() - 2}) {
    ArithmeticDecoder in(bytes_of(bytes).first(kept));
    std::size_t right = 0;
    bool all_right = true;
    for (const bool bit : bits) {
      all_right = (in.decode(32768) == bit) && all_right;
      right += all_right;
    }
    CHECK(right >= (kept > 4 ? (kept - 4) * 8 : 0));  // up to 4 bytes are under way
    CHECK(in.exhausted());
    CHECK_FALSE(in.at_end());
  }
}

TEST_CASE("arithmetic coder: integers of every size, and any bytes give some integer") {
  std::vector<std::int32_t> values{
      0, 1, -1, 2, -2, 3, 7, -8, 255, std::numeric_limits<std::int32_t>::max(), -std::numeric_limits<std::int32_t>::max()};
  Rng rng(9);
  for (int i = 0; i < 5000; ++i) {
    const auto magnitude = static_cast<std::int32_t>(rng.next() >> (33 + rng.below(31)));
    values.push_back(rng.coin() ? magnitude : -magnitude);
  }
  ArithmeticEncoder out;
  AdaptiveInteger model;
  for (const std::int32_t value : values) model.encode(value, out);
  const std::string bytes = out.finish();
  ArithmeticDecoder in(bytes_of(bytes));
  AdaptiveInteger again;
  for (const std::int32_t value : values) REQUIRE(again.decode(in) == value);
  CHECK(in.at_end());

  std::string noise(400, '\0');
  for (char& c : noise) c = static_cast<char>(rng.next());
  ArithmeticDecoder wild(bytes_of(noise));
  AdaptiveInteger any;
  for (int i = 0; i < 2000; ++i) CHECK(any.decode(wild) > std::numeric_limits<std::int32_t>::min());
}

TEST_CASE("arithmetic coder: the bytes are the same everywhere") {
  ArithmeticEncoder out;
  AdaptiveInteger model;
  Rng rng(10);
  for (int i = 0; i < 3000; ++i) model.encode(static_cast<std::int32_t>(rng.between(-40, 60)), out);
  CHECK(sha256_hex(bytes_of(coded(biased_bits(5000, 60, 1)))) == "ab0c11a1d0bb595cb0d877ddde1082f174f69d97ef571818da8373db2be7c749");
  CHECK(sha256_hex(bytes_of(out.finish())) == "c6dffc2d6261dd00817d49b568c65e07d1e5bd19c1a6012df1b0ae994343549f");
}
