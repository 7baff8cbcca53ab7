#include "core/math/wide_int.h"

#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include "core/base/rng.h"

using boost::multiprecision::cpp_int;
using etalon::Rng;
using etalon::WideInt;

namespace {

// A random integer of a random length up to `bits`, in both representations.
template <int kLimbs>
std::pair<WideInt<kLimbs>, cpp_int> random_pair(Rng& rng, int bits) {
  const int length = static_cast<int>(rng.below(static_cast<std::uint64_t>(bits) + 1));
  WideInt<kLimbs> w;
  cpp_int c = 0;
  for (int b = 0; b < length; b += 32) {
    const int take = std::min(32, length - b);
    const auto chunk = static_cast<std::int64_t>(rng.next() >> (64 - take));
    w = (w << take) + WideInt<kLimbs>(chunk);
    c = (c << take) + chunk;
  }
  if (rng.coin()) w = -w, c = -c;
  return {w, c};
}

template <int kLimbs>
cpp_int to_cpp(const WideInt<kLimbs>& w) {
  const WideInt<kLimbs> a = w.abs();
  cpp_int c = 0;
  for (int i = kLimbs - 1; i >= 0; --i) c = (c << 64) + a.limb[static_cast<std::size_t>(i)];
  return w.negative() ? -c : c;
}

}  // namespace

TEST_CASE_TEMPLATE("wide integers agree with Boost on every operation", Limbs, std::integral_constant<int, 2>,
                   std::integral_constant<int, 4>, std::integral_constant<int, 16>) {
  constexpr int kLimbs = Limbs::value;
  Rng rng(7);
  for (int n = 0; n < 20000; ++n) {
    const auto [a, ca] = random_pair<kLimbs>(rng, 32 * kLimbs - 2);
    const auto [b, cb] = random_pair<kLimbs>(rng, 32 * kLimbs - 2);
    REQUIRE(to_cpp(a) == ca);
    CHECK(to_cpp(a + b) == ca + cb);
    CHECK(to_cpp(a - b) == ca - cb);
    CHECK(to_cpp(a * b) == ca * cb);
    CHECK(to_cpp(-a) == -ca);
    const int shift = static_cast<int>(rng.below(32 * kLimbs));
    CHECK(to_cpp(a << shift) == cpp_int(ca << shift));
    CHECK(WideInt<kLimbs>::compare(a, b) == (ca < cb ? -1 : ca > cb ? 1 : 0));
    CHECK(a.sign() == ca.sign());
    CHECK(a.bit_length() == (ca == 0 ? 0 : static_cast<int>(msb(cpp_int(abs(ca)))) + 1));
  }
}

TEST_CASE("leading() keeps 64 bits and the scale") {
  const WideInt<4> x = (WideInt<4>(5) << 150) + WideInt<4>(1);
  CHECK(x.leading().mantissa == std::uint64_t{5} << 61);
  CHECK(x.leading().exponent == 150 - 61);
  CHECK(WideInt<4>(-3).leading().mantissa == 3);
  CHECK(WideInt<4>().leading().mantissa == 0);
}

TEST_CASE("the least 128-bit integer keeps its value") {
  const __int128 least = static_cast<__int128>(1) << 127;
  CHECK(WideInt<4>(least).negative() == (least < 0));
  CHECK(WideInt<4>(least).bit_length() == 128);
}
