// Our own random numbers: std:: distributions are not specified bit for bit, these are.
#pragma once

#include <cstdint>

namespace etalon {

/// SplitMix64 [Steele, Lea & Flood 2014]: 64 uniform bits per call, equal on every platform for equal seeds.
class Rng {
 public:
  constexpr explicit Rng(std::uint64_t seed) : state_(seed) {}

  constexpr std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }

  /// Uniform in [0, n), n > 0, without modulo bias beyond n/2^64.
  constexpr std::uint64_t below(std::uint64_t n) { return static_cast<std::uint64_t>((static_cast<unsigned __int128>(next()) * n) >> 64); }

  /// Uniform integer in [lo, hi], both included.
  constexpr std::int64_t between(std::int64_t lo, std::int64_t hi) {
    return lo + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(hi - lo) + 1));
  }

  /// Uniform in [0, 1): a multiple of 2^-53, exact.
  constexpr double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  /// Uniform float32 in [lo, hi): lo + unit()·(hi − lo) in double, rounded once.
  constexpr float uniform(float lo, float hi) {
    return static_cast<float>(static_cast<double>(lo) + unit() * (static_cast<double>(hi) - static_cast<double>(lo)));
  }

  constexpr bool coin() { return (next() >> 63) != 0; }

 private:
  std::uint64_t state_;
};

}  // namespace etalon
