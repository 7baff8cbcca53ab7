#include "core/math/quotient.h"

#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

#include "core/base/rng.h"

using namespace etalon;
using Rational = boost::multiprecision::cpp_rational;

namespace {

Rational power(int e) {
  const boost::multiprecision::cpp_int one = 1;
  return e >= 0 ? Rational(one << e) : Rational(one, one << -e);
}

// Dyadic numbers, their neighbourhoods within 2^-60, and random quotients: where a conversion could go wrong.
struct Case {
  Quotient<8> q;
  Rational exact;
};
std::vector<Case> cases() {
  std::vector<Case> all;
  Rng rng(11);
  const auto add = [&](std::int64_t n, std::int64_t d, int k, int nudge) {
    // (n·2^100 + nudge·d) / (d·2^(100+k)) lies n/(d·2^k) + nudge·2^-(100+k)
    Case c;
    c.q = {(WideInt<8>(n) << 100) + WideInt<8>(nudge) * WideInt<8>(d), WideInt<8>(d), k + 100};
    c.exact = (Rational(n, d) + nudge * power(-100)) * power(-k);
    all.push_back(c);
  };
  for (int n = 0; n < 3000; ++n) {
    const int nudge = static_cast<int>(rng.below(3)) - 1;
    add(rng.between(-70000, 70000), 1, static_cast<int>(rng.below(20)), nudge);            // few bits: ties of half, unorm
    add(rng.between(-(1 << 25), 1 << 25), 1, static_cast<int>(rng.below(60)) - 5, nudge);  // 25 bits: ties of float32
    add(rng.between(-2000, 2000), 510, 0, nudge);                                          // halves of 1/255
    add(rng.between(-200000, 200000), 131070, 0, nudge);                                   // halves of 1/65535
    add(rng.between(-1000000000000, 1000000000000), rng.between(1, 1000000000000), static_cast<int>(rng.below(80)) - 40, nudge);
    add(rng.between(-1000, 1000), 8, 146, nudge);  // float32 subnormals
  }
  return all;
}

Rational of(float f) { return Rational(f); }

}  // namespace

TEST_CASE("float32: no neighbour is nearer, and a tie is even") {
  for (const Case& c : cases()) {
    const float f = to_float32(c.q, enclose(c.q));
    REQUIRE(std::isfinite(f));
    const Rational distance = abs(of(f) - c.exact);
    for (const float other : {std::nextafter(f, 1e38f), std::nextafter(f, -1e38f)}) {
      const Rational theirs = abs(of(other) - c.exact);
      REQUIRE(distance <= theirs);
      if (distance == theirs) REQUIRE((std::bit_cast<std::uint32_t>(f) & 1) == 0);
    }
    if (f == 0) REQUIRE(!std::signbit(f));
  }
}

TEST_CASE("half: nearest even and truncated, by their definitions") {
  for (const Case& c : cases()) {
    if (abs(c.exact) > 65519) continue;
    const std::uint16_t near = to_half(c.q, enclose(c.q), false), cut = to_half(c.q, enclose(c.q), true);
    REQUIRE(near != 0x8000);
    REQUIRE(cut != 0x8000);
    const Rational distance = abs(Rational(half_to_double(near)) - c.exact);
    const auto check = [&](std::uint16_t other) {
      if ((other & 0x7C00) == 0x7C00) return;
      const Rational theirs = abs(Rational(half_to_double(other)) - c.exact);
      REQUIRE(distance <= theirs);
      if (distance == theirs && (other & 0x7FFF) != 0 && near != 0) REQUIRE((near & 1) == 0);
    };
    if ((near & 0x7FFF) != 0) check(static_cast<std::uint16_t>(near - 1));
    check(static_cast<std::uint16_t>(near + 1));
    const Rational truncated(half_to_double(cut));
    REQUIRE(abs(truncated) <= abs(c.exact));
    if ((cut & 0x7FFF) < 0x7BFF) {
      const std::uint16_t sign = c.exact < 0 ? 0x8000 : 0;
      REQUIRE(abs(Rational(half_to_double(static_cast<std::uint16_t>(sign | ((cut & 0x7FFF) + 1))))) > abs(c.exact));
    }
  }
}

TEST_CASE("unorm: nearest to the clamped value, ties to even") {
  for (const Case& c : cases())
    for (const std::uint32_t scale : {255u, 65535u}) {
      const std::uint32_t got = to_unorm(c.q, enclose(c.q), scale);
      const Rational x = (c.exact < 0 ? Rational(0) : c.exact > 1 ? Rational(1) : c.exact) * scale;
      const Rational distance = abs(Rational(got) - x);
      REQUIRE(distance <= Rational(1, 2));
      if (distance == Rational(1, 2)) REQUIRE(got % 2 == 0);
    }
}

TEST_CASE("floor and comparison") {
  for (const Case& c : cases()) {
    if (abs(c.exact) > Rational(1LL << 40)) continue;
    const std::int64_t f = floor_of(c.q, enclose(c.q));
    REQUIRE(Rational(f) <= c.exact);
    REQUIRE(c.exact < Rational(f + 1));
    for (const double t : {0.0, 1.0, -0.375, static_cast<double>(f)})
      REQUIRE(compare(c.q, t) == (c.exact < Rational(t) ? -1 : c.exact > Rational(t) ? 1 : 0));
  }
}

TEST_CASE("enclosures hold the number") {
  for (const Case& c : cases()) {
    const Interval v = enclose(c.q);
    REQUIRE(Rational(v.lo) <= c.exact);
    REQUIRE(c.exact <= Rational(v.hi));
  }
}
