// The generator is part of every seeded test and procedural model: its numbers are golden.
#include "core/base/rng.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>

using etalon::Rng;

TEST_CASE("rng: SplitMix64's published first outputs for seed 1234567") {
  Rng rng(1234567);
  CHECK(rng.next() == 6457827717110365317ull);
  CHECK(rng.next() == 3203168211198807973ull);
  CHECK(rng.next() == 9817491932198370423ull);
  CHECK(rng.next() == 4593380528125082431ull);
  CHECK(rng.next() == 16408922859458223821ull);
}

TEST_CASE("rng: it works at compile time, with the same numbers") {
  constexpr std::uint64_t first = [] { return Rng(1234567).next(); }();
  static_assert(first == 6457827717110365317ull);
}

TEST_CASE("rng: below reaches every value and no other") {
  Rng rng(2);
  std::array<int, 7> hits{};
  for (int i = 0; i < 7000; ++i) {
    const std::uint64_t value = rng.below(7);
    REQUIRE(value < 7);
    ++hits[value];
  }
  // Binomial, mean 1000, sigma 29.3: 6 sigma; the seed is fixed, so this never fails by chance.
  for (const int count : hits) CHECK((count > 824 && count < 1176));
  CHECK(rng.below(1) == 0);
}

TEST_CASE("rng: between holds both ends, over the whole range of its type too") {
  Rng rng(3);
  bool low = false, high = false;
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t value = rng.between(-2, 3);
    REQUIRE((value >= -2 && value <= 3));
    low |= value == -2;
    high |= value == 3;
  }
  CHECK((low && high));
  CHECK(rng.between(5, 5) == 5);
}

TEST_CASE("rng: unit is a multiple of 2^-53 below 1") {
  Rng rng(4);
  for (int i = 0; i < 1000; ++i) {
    const double value = rng.unit();
    REQUIRE((value >= 0 && value < 1));
    const double scaled = value * 0x1p53;
    CHECK(scaled == static_cast<double>(static_cast<std::uint64_t>(scaled)));
  }
}

TEST_CASE("rng: uniform stays in its range and uses it") {
  Rng rng(5);
  float least = 10, most = -10;
  for (int i = 0; i < 1000; ++i) {
    const float value = rng.uniform(-2, 6);
    least = std::min(least, value);
    most = std::max(most, value);
  }
  CHECK((least >= -2 && least < -1.9f));
  CHECK((most <= 6 && most > 5.9f));
}

TEST_CASE("rng: coin falls on both sides") {
  Rng rng(6);
  int heads = 0;
  for (int i = 0; i < 1000; ++i) heads += rng.coin() ? 1 : 0;
  CHECK((heads > 400 && heads < 600));  // 6.3 sigma
}
