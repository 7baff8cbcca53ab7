#include "validation/storage_rounding.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "core/base/rng.h"
#include "core/math/half.h"
#include "core/math/srgb.h"

namespace etalon::validation {
namespace {

template <class T>
const std::byte* bytes(const T& value) {
  return reinterpret_cast<const std::byte*>(&value);
}

TEST_CASE("every half is the rounding of exactly the numbers of its preimage, both roundings") {
  for (const HalfRounding rounding : {HalfRounding::nearest_even, HalfRounding::toward_zero}) {
    const auto round = [&](double x) { return rounding == HalfRounding::nearest_even ? half_nearest_even(x) : half_toward_zero(x); };
    for (unsigned h = 0; h < 0x10000; ++h) {
      const auto half = static_cast<std::uint16_t>(h);
      const Preimage p = stored_preimage(bytes(half), {ChannelType::half, 1}, 0, rounding);
      if ((h & 0x7C00) == 0x7C00 && ((h & 0x3FF) != 0 || rounding == HalfRounding::toward_zero)) {
        CHECK(p.lo > p.hi);  // NaN, and inf where finite numbers are truncated: nothing rounds to them
        continue;
      }
      REQUIRE(p.lo < p.hi);
      const double lo = std::isinf(p.lo) ? -1e30 : p.lo, hi = std::isinf(p.hi) ? 1e30 : p.hi;
      const auto same = [&](double x) {
        return ((round(x) ^ half) & (h % 0x8000 == 0 ? 0x7FFF : 0xFFFF)) == 0;
      };  // both zeros are one number
      REQUIRE(same(lo + (hi - lo) * 0.5));
      REQUIRE(same(std::nextafter(lo, hi)));
      REQUIRE(same(std::nextafter(hi, lo)));
      if (!std::isinf(p.lo)) REQUIRE_FALSE(same(std::nextafter(lo, -1e300)));
      if (!std::isinf(p.hi)) REQUIRE_FALSE(same(std::nextafter(hi, 1e300)));
    }
  }
}

TEST_CASE("unorm and sRGB preimages tile the line, and hold their own value") {
  for (unsigned k = 0; k < 65536; ++k) {
    const auto code = static_cast<std::uint16_t>(k);
    const Preimage p = stored_preimage(bytes(code), {ChannelType::unorm16, 1}, 0, HalfRounding::nearest_even);
    REQUIRE(p.lo < k / 65535.0);
    REQUIRE(p.hi > k / 65535.0);
    if (k > 0) REQUIRE(p.lo == (k - 0.5) / 65535.0);
  }
  for (unsigned k = 0; k < 256; ++k) {
    const std::uint8_t texel[4] = {static_cast<std::uint8_t>(k), 0, 0, static_cast<std::uint8_t>(k)};
    const Preimage curve = stored_preimage(bytes(texel), {ChannelType::srgb8, 4}, 0, HalfRounding::nearest_even);
    CHECK(curve.lo < static_cast<double>(kSrgbDecode[k]));
    CHECK(curve.hi > static_cast<double>(kSrgbDecode[k]));
    const Preimage alpha = stored_preimage(bytes(texel), {ChannelType::srgb8, 4}, 3, HalfRounding::nearest_even);
    CHECK(alpha.lo < k / 255.0);
    CHECK(alpha.hi > k / 255.0);
  }
}

TEST_CASE("a float32 product and round, as devices convert to unorm, is legal for its exact input with bound 0; the neighbours are not") {
  Rng rng(1);
  const DeviceModel device = llvmpipe_model();
  for (int n = 0; n < 500'000; ++n) {
    const float x = rng.uniform(-0.1f, 1.1f);
    const float clamped = std::min(std::max(x, 0.0f), 1.0f);
    const auto code8 = static_cast<std::uint8_t>(std::nearbyint(clamped * 255.0f));
    const auto code16 = static_cast<std::uint16_t>(std::nearbyint(clamped * 65535.0f));
    const Bounded exact{static_cast<double>(x), 0};
    REQUIRE(check_stored(bytes(code8), {ChannelType::unorm8, 1}, 0, HalfRounding::nearest_even, exact, device).legal);
    REQUIRE(check_stored(bytes(code16), {ChannelType::unorm16, 1}, 0, HalfRounding::nearest_even, exact, device).legal);
    const auto next8 = static_cast<std::uint8_t>(code8 == 255 ? 254 : code8 + 1);
    const double to_tie = std::abs(std::abs(static_cast<double>(clamped) * 255 - code8) - 0.5);
    if (to_tie > 2e-5)
      REQUIRE_FALSE(check_stored(bytes(next8), {ChannelType::unorm8, 1}, 0, HalfRounding::nearest_even, exact, device).legal);
  }
}

TEST_CASE("the share of the bound that is needed") {
  const DeviceModel device = llvmpipe_model();
  const PixelFormat r32f{ChannelType::float32, 1};
  const auto share = [&](float stored, double value, double bound) {
    return check_stored(bytes(stored), r32f, 0, HalfRounding::nearest_even, {value, bound}, device);
  };
  CHECK(share(1.0f, 1.0, 1e-6).share == 0);
  CHECK(share(1.5f, 1.0, 1.0).share == doctest::Approx(0.5));
  CHECK(share(1.5f, 1.0, 1.0).legal);
  CHECK_FALSE(share(1.5f, 1.0, 0.25).legal);
  CHECK(share(-0.0f, 0.0, 0).legal);
  CHECK_FALSE(share(std::bit_cast<float>(0x7FC00000u), 1.0, 10).legal);
  // Any code that rounding can reach needs nothing.
  const std::uint8_t code = 128;
  CHECK(check_stored(bytes(code), {ChannelType::unorm8, 1}, 0, HalfRounding::nearest_even, {128.4 / 255, 0}, device).share == 0);
}

TEST_CASE("unorm within 0.6 steps, where a specification allows that") {
  DeviceModel loose = specified_model("loose", 2, 8, "");
  const auto legal = [&](std::uint8_t code, double value) {
    return check_stored(bytes(code), {ChannelType::unorm8, 1}, 0, HalfRounding::nearest_even, {value, 0}, loose).legal;
  };
  CHECK_FALSE(legal(10, 10.59 / 255));
  loose.unorm_error_steps = 0.1;
  CHECK(legal(10, 10.59 / 255));
  CHECK_FALSE(legal(10, 10.61 / 255));
}

TEST_CASE("truncated unorm, where it is asked for") {
  DeviceModel truncating = llvmpipe_model();
  truncating.unorm_toward_zero = true;
  const auto legal = [&](std::uint8_t code, double value) {
    return check_stored(bytes(code), {ChannelType::unorm8, 1}, 0, HalfRounding::nearest_even, {value, 0}, truncating).legal;
  };
  CHECK(legal(10, 10.9 / 255));
  CHECK_FALSE(legal(11, 10.9 / 255));
  CHECK(legal(254, 254.9 / 255));
  CHECK(legal(255, 1.0));
  CHECK(legal(255, 3.0));
  CHECK(legal(0, -1.0));
}

}  // namespace
}  // namespace etalon::validation
