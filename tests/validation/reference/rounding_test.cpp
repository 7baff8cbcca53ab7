// The two ways the judge rounds, against literals and against the hardware's own conversion of doubles.

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "validation/reference/fraction.h"
#include "validation/reference/rational.h"
#include "validation/reference/stored_number.h"

namespace etalon::validation::reference {

namespace {

// value = m · 2^e as fraction and as rational, both exact.
Fraction fraction_of(std::int64_t m, int e) { return e >= 0 ? Fraction{BigInt(m) << e, 1} : Fraction{m, BigInt(1) << -e}; }
BigRational rational_of(std::int64_t m, int e) {
  using boost::multiprecision::cpp_int;
  return e >= 0 ? BigRational(cpp_int(m) << e) : BigRational(cpp_int(m), cpp_int(1) << -e);
}

std::uint32_t stored_both(const Fraction& f, const BigRational& q, ChannelType type, HalfRounding rounding = HalfRounding::nearest_even,
                          int channel = 0) {
  std::byte a[16] = {}, b[16] = {};
  store_channel(f, {type, 4}, channel, rounding, a);
  store_rational(q, {type, 4}, channel, rounding, b);
  CHECK(std::memcmp(a, b, 16) == 0);
  const int size = bytes_per_channel(type);
  std::uint32_t bits = 0;
  std::memcpy(&bits, a + channel * size, static_cast<std::size_t>(size));
  return bits;
}

std::uint32_t half_of(std::int64_t m, int e, HalfRounding rounding = HalfRounding::nearest_even) {
  return stored_both(fraction_of(m, e), rational_of(m, e), ChannelType::half, rounding);
}
std::uint32_t float_of(std::int64_t m, int e) { return stored_both(fraction_of(m, e), rational_of(m, e), ChannelType::float32); }
std::uint32_t quotient_of(std::int64_t n, std::int64_t d, ChannelType type) { return stored_both({n, d}, BigRational(n, d), type); }

}  // namespace

TEST_CASE("float32: as the hardware rounds doubles, subnormals and overflow included") {
  Rng rng(1);
  for (int n = 0; n < 20'000; ++n) {
    // 53 bits, or few beyond 24 so that ties are common.
    const std::int64_t m = n % 2 == 0 ? rng.between(-(1LL << 53), 1LL << 53) : rng.between(-(1LL << 26), 1LL << 26);
    const int e = static_cast<int>(rng.between(-190, 100));
    const float expected = static_cast<float>(std::ldexp(static_cast<double>(m), e));
    CHECK(float_of(m, e) == std::bit_cast<std::uint32_t>(expected == 0 ? 0.0f : expected));
  }
}

TEST_CASE("float32: literals") {
  CHECK(float_of(0, 0) == 0);
  CHECK(float_of(1, -149) == 1);
  CHECK(float_of(1, -150) == 0);   // the middle of 0 and the least subnormal: even
  CHECK(float_of(3, -150) == 2);   // the middle of 1 and 2: even
  CHECK(float_of(-1, -150) == 0);  // whatever rounds to zero is +0
  CHECK(float_of((1 << 25) + 1, 0) == std::bit_cast<std::uint32_t>(0x1p25f));
  CHECK(float_of((1 << 25) + 2, 0) == std::bit_cast<std::uint32_t>(0x1p25f));         // tie: even
  CHECK(float_of((1 << 25) + 6, 0) == std::bit_cast<std::uint32_t>(0x1.000004p25f));  // tie: even is above
  CHECK(float_of((1 << 25) + 3, 0) == std::bit_cast<std::uint32_t>(0x1.000002p25f));
  CHECK(float_of((1 << 25) - 1, 103) == 0x7F800000u);  // 2^128 − 2^103 is the middle beyond the largest
  CHECK(float_of((1 << 26) - 3, 102) == 0x7F7FFFFFu);
  CHECK(quotient_of(1, 3, ChannelType::float32) == std::bit_cast<std::uint32_t>(1.0f / 3.0f));
  CHECK(quotient_of(-2, 7, ChannelType::float32) == std::bit_cast<std::uint32_t>(-2.0f / 7.0f));
}

TEST_CASE("half: the borders the contract names") {
  CHECK(half_of(65519, 0) == 0x7BFF);
  CHECK(half_of(65520, 0) == 0x7C00);
  CHECK(half_of(-65520, 0) == 0xFC00);
  CHECK(half_of(65520, 0, HalfRounding::toward_zero) == 0x7BFF);
  CHECK(half_of(1, 40, HalfRounding::toward_zero) == 0x7BFF);
  CHECK(half_of(-1, 40, HalfRounding::toward_zero) == 0xFBFF);
  CHECK(half_of(1, 0) == 0x3C00);
  CHECK(half_of(2049, -11) == 0x3C00);  // 1 + 2^-11: tie to even
  CHECK(half_of(2051, -11) == 0x3C02);  // 1 + 3·2^-11: tie to even
  CHECK(half_of(2051, -11, HalfRounding::toward_zero) == 0x3C01);
  CHECK(half_of(1, -24) == 1);
  CHECK(half_of(1, -25) == 0);
  CHECK(half_of(3, -25) == 2);
  CHECK(half_of(3, -25, HalfRounding::toward_zero) == 1);
  CHECK(half_of(-1, -30) == 0);
  CHECK(half_of(4095, -26) == 0x0400);  // rounds up out of the subnormals
  CHECK(half_of(4095, -26, HalfRounding::toward_zero) == 0x03FF);
}

TEST_CASE("half: every finite one is stored as itself, under both roundings") {
  for (std::uint32_t bits = 0; bits < 0x7C00; ++bits)
    for (const std::uint32_t sign : {0u, 0x8000u}) {
      const Binary b = binary_of_half(static_cast<std::uint16_t>(bits | sign));
      const std::uint32_t expected = bits == 0 ? 0 : bits | sign;
      CHECK(round_to_half(fraction_of(b.m, b.e), HalfRounding::nearest_even) == expected);
      CHECK(round_to_half(fraction_of(b.m, b.e), HalfRounding::toward_zero) == expected);
    }
}

TEST_CASE("unorm: clamped, then nearest, ties to even") {
  CHECK(quotient_of(-1, 5, ChannelType::unorm8) == 0);
  CHECK(quotient_of(7, 5, ChannelType::unorm8) == 255);
  CHECK(quotient_of(1, 2, ChannelType::unorm8) == 128);      // 127.5
  CHECK(quotient_of(1, 510, ChannelType::unorm8) == 0);      // 0.5
  CHECK(quotient_of(3, 510, ChannelType::unorm8) == 2);      // 1.5
  CHECK(quotient_of(301, 51000, ChannelType::unorm8) == 2);  // 1.505
  CHECK(quotient_of(509, 510, ChannelType::unorm8) == 254);  // 254.5
  CHECK(quotient_of(1, 2, ChannelType::unorm16) == 32768);
  CHECK(quotient_of(1, 65535, ChannelType::unorm16) == 1);
}

TEST_CASE("srgb8: colour channels by the curve, the fourth as unorm") {
  CHECK(quotient_of(1, 2, ChannelType::srgb8) == 188);
  CHECK(quotient_of(-1, 2, ChannelType::srgb8) == 0);
  CHECK(quotient_of(3, 2, ChannelType::srgb8) == 255);
  CHECK(stored_both({1, 2}, BigRational(1, 2), ChannelType::srgb8, HalfRounding::nearest_even, 3) == 128);
}

TEST_CASE("a quotient by a root: exact roots, ties and their neighbours") {
  CHECK(round_quotient_by_root(0, 5) == 0);
  CHECK(round_quotient_by_root(6, 4) == 3);
  CHECK(round_quotient_by_root(1, 2) == static_cast<float>(std::sqrt(0.5)));
  const BigInt tie = (1 << 25) + 2;  // halfway between two float32
  CHECK(round_quotient_by_root(tie, 1) == 0x1p25f);
  CHECK(round_quotient_by_root(tie * 3, 9) == 0x1p25f);
  CHECK(round_quotient_by_root(tie * 1000000 + 1, BigInt(1000000) * 1000000) == 0x1.000002p25f);
  Rng rng(2);
  for (int n = 0; n < 2'000; ++n) {
    const auto e = rng.between(1, 1LL << 61), dx = rng.between(-(1LL << 30), 1LL << 30), dy = rng.between(1, 1LL << 30);
    const BigInt square = BigInt(dx) * dx + BigInt(dy) * dy;
    const BigRational exact_square =
        BigRational(boost::multiprecision::cpp_int(e) * e, square.convert_to<boost::multiprecision::cpp_int>());
    CHECK(round_quotient_by_root(e, square) == nearest_float32([&](const BigRational& y) { return exact_square.compare(y * y); }));
  }
}

TEST_CASE("fixed point and stored numbers are exact; what is not a number, too fine or too far is an InternalError") {
  CHECK(fixed_point(0x1.fffffep-40f, 63) == 0xFFFFFF);
  CHECK(fixed_point(-0x1p40f, 63) == -(BigInt(1) << 103));
  CHECK(fixed_point(0.0f, 63) == 0);
  CHECK_THROWS_AS((void)fixed_point(0x1.fffffep-41f, 63), InternalError);
  CHECK_THROWS_AS((void)fixed_point(0x1p-149f, 63), InternalError);
  CHECK_THROWS_AS((void)exact(std::numeric_limits<float>::infinity()), InternalError);
  CHECK_THROWS_AS((void)exact(std::numeric_limits<float>::quiet_NaN()), InternalError);
  CHECK_THROWS_AS((void)binary_of_half(0x7C00), InternalError);
  CHECK_THROWS_AS((void)round_quotient_by_root(BigInt(1) << 200, 1), InternalError);
  std::byte texel[16];
  CHECK_THROWS_AS(store_channel({1, 2}, kR32ui, 0, HalfRounding::nearest_even, texel), InternalError);
  CHECK_THROWS_AS(store_rational(BigRational(1, 2), kR32ui, 0, HalfRounding::nearest_even, texel), InternalError);
  for (const float value : {1.0f, -0.3f, 0x1p-149f, 0x1.8p-130f, std::numeric_limits<float>::max()}) {
    const Binary b = binary_of_float32(value);
    CHECK(std::ldexp(static_cast<double>(b.m), b.e) == value);
  }
}

TEST_CASE("floor division rounds down on both sides of zero") {
  CHECK(floor_div(7, 2) == 3);
  CHECK(floor_div(-7, 2) == -4);
  CHECK(floor_div(-8, 2) == -4);
  CHECK(floor_of(BigRational(-7, 2)) == -4);
  CHECK(floor_of(BigRational(-4)) == -4);
}

}  // namespace etalon::validation::reference
