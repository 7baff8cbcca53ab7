// The cheap exact path: which texel a coordinate names, and how far into it, in 128-bit integers where they hold everything. True ties
// end here, and so do linear lookups whose fraction, as a difference of doubles, is too uncertain for a float32 target.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

namespace etalon::raster {

/// u·size − offset/2 = index + fraction: the index exact, the fraction in [0, 1] within 2^-51 relative.
struct NarrowSplit {
  std::int64_t index;
  double fraction;
};

/// Splits n/d, d > 0, |n/d| < 2^31, |n| and d below 2^126.
[[nodiscard]] inline NarrowSplit narrow_split(__int128 n, __int128 d) {
  // The double quotient errs by less than 2^-51·2^31: its floor is right or next to it.
  auto index = static_cast<std::int64_t>(std::floor(static_cast<double>(n) / static_cast<double>(d)));
  __int128 rest = n - index * d;
  while (rest < 0) rest += d, --index;
  while (rest >= d) rest -= d, ++index;
  return {index, static_cast<double>(rest) / static_cast<double>(d)};  // three roundings
}

}  // namespace etalon::raster
