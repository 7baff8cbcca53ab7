// The sRGB curve as the contract defines it: exact tables, no libm (docs/contract.md#srgb).
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/math/quotient.h"

namespace etalon {

#include "core/math/srgb_table.inc"

/// The byte whose interval holds the exact number: how many thresholds it has reached.
template <int kLimbs>
[[nodiscard]] std::uint8_t to_srgb8(const Quotient<kLimbs>& q, Interval v) {
  const auto reached = [](double x) {
    return static_cast<int>(std::upper_bound(std::begin(kSrgbThreshold), std::end(kSrgbThreshold), x) - std::begin(kSrgbThreshold));
  };
  const int lo = reached(v.lo), hi = reached(v.hi);
  if (lo == hi) return static_cast<std::uint8_t>(lo);
  return static_cast<std::uint8_t>(compare(q, static_cast<double>(kSrgbThreshold[hi - 1])) >= 0 ? hi : lo);
}

}  // namespace etalon
