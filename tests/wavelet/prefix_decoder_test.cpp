#include "core/wavelet/prefix_decoder.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/base/rng.h"

using namespace etalon;
using wavelet::PrefixDecoder;

namespace {

struct Bits {
  std::vector<bool> bits;
  std::vector<std::uint32_t> probabilities;
  std::vector<std::byte> bytes;
};

Bits encoded_bits(std::uint64_t seed, int count) {
  Rng rng(seed);
  Bits made;
  ArithmeticEncoder encoder;
  for (int i = 0; i < count; ++i) {
    const auto probability = static_cast<std::uint32_t>(rng.between(1, 65535));
    const bool bit = rng.below(65536) < probability;
    encoder.encode(bit, probability);
    made.bits.push_back(bit);
    made.probabilities.push_back(probability);
  }
  const std::string text = encoder.finish();
  for (const char c : text) made.bytes.push_back(static_cast<std::byte>(c));
  return made;
}

// Bits that follow from the first `known` bytes.
std::size_t determined_bits(const Bits& made, std::span<const std::byte> bytes, std::size_t known) {
  PrefixDecoder decoder(bytes, known);
  std::size_t n = 0;
  while (n < made.bits.size() && decoder.is_determined(made.probabilities[n])) {
    REQUIRE(decoder.decode(made.probabilities[n]) == made.bits[n]);
    ++n;
  }
  return n;
}

}  // namespace

TEST_CASE("prefix decoder: a prefix gives right bits, whatever follows, and no fewer than it must") {
  Rng rng(5);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Bits made = encoded_bits(seed, 400);
    std::size_t before = 0;
    for (std::size_t known = 0; known <= made.bytes.size(); ++known) {
      const std::size_t n = determined_bits(made, made.bytes, known);
      CHECK(n >= before);
      before = n;
      // The same number from the prefix alone, and with other bytes behind it.
      std::vector<std::byte> cut(made.bytes.begin(), made.bytes.begin() + static_cast<std::ptrdiff_t>(known));
      CHECK(determined_bits(made, cut, known) == n);
      for (int i = 0; i < 8; ++i) cut.push_back(static_cast<std::byte>(rng.next() & 0xFF));
      CHECK(determined_bits(made, cut, known) == n);
      // The next bit is open: one of the two extreme continuations gives the other value.
      if (n == made.bits.size()) continue;
      bool seen[2] = {false, false};
      for (const auto filling : {std::byte{0}, std::byte{255}}) {
        std::vector<std::byte> filled(made.bytes.begin(), made.bytes.begin() + static_cast<std::ptrdiff_t>(known));
        filled.resize(known + 40, filling);
        PrefixDecoder decoder(filled, filled.size());
        for (std::size_t i = 0; i < n; ++i) (void)decoder.decode(made.probabilities[i]);
        seen[decoder.decode(made.probabilities[n]) ? 1 : 0] = true;
      }
      CHECK((seen[0] && seen[1]));
    }
  }
}

TEST_CASE("prefix decoder: needed bytes are the fewest that determine what was decoded") {
  const Bits made = encoded_bits(77, 600);
  PrefixDecoder decoder(made.bytes, made.bytes.size());
  for (std::size_t n = 1; n <= 500; ++n) {
    (void)decoder.decode(made.probabilities[n - 1]);
    const std::size_t needed = decoder.needed_bytes();
    CHECK(determined_bits(made, made.bytes, needed) >= n);
    if (needed > 0) CHECK(determined_bits(made, made.bytes, needed - 1) < n);
  }
}
