// The contexts of the embedded coder: what the neighbours of a coefficient or block say about its next bit.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/base/arithmetic_coder.h"
#include "core/wavelet/band_state.h"

namespace etalon::wavelet {

inline constexpr int kParentWeight = 2, kLumaWeight = 1;
inline constexpr int kMaxActivity = 31;
inline constexpr std::size_t kActivityClasses = 12;
inline constexpr std::size_t kBlockDepths = 3, kBlockClasses = 6;

// Classes of the weighted sums below: single values while they are small, ranges later.
inline constexpr std::array<std::uint8_t, kMaxActivity + 1> kActivityClass = {0, 1, 2, 3, 4, 5,  5,  6,  6,  7,  7,  7,  8,  8,  8,  8,
                                                                              9, 9, 9, 9, 9, 10, 10, 10, 10, 10, 10, 11, 11, 11, 11, 11};
inline constexpr std::array<std::uint8_t, 13> kBlockClass = {0, 1, 2, 3, 3, 4, 4, 4, 5, 5, 5, 5, 5};

struct ChannelContexts {
  std::array<std::array<AdaptiveBit, kActivityClasses>, 2> coefficient;  ///< [diagonal band?][activity]
  std::array<std::array<std::array<std::array<AdaptiveBit, kBlockClasses>, 3>, kBlockDepths>, 2>
      block;                                       ///< [in a split?][depth][above][class]
  std::array<std::array<AdaptiveBit, 5>, 2> sign;  ///< [diagonal band?]
  std::array<AdaptiveBit, 4> refinement;
};

/// Luma has contexts of its own, the two colour channels share theirs.
struct ContextModels {
  std::array<ChannelContexts, 2> channels;
  [[nodiscard]] ChannelContexts& of_channel(int channel) { return channels[channel == 0 ? 0 : 1]; }
};

/// Size of a known coefficient against 2^bit: 0 below, 1 in [1, 2)·2^bit, 2 above. Any bit.
[[nodiscard]] inline int graded(std::uint32_t known, int bit) {
  const std::uint32_t magnitude = known & ~kSignBit;
  if (bit < 0) return magnitude == 0 ? 0 : 2;
  return bit > 31 ? 0 : static_cast<int>(std::min(magnitude >> bit, 2u));
}

/// Weighted sum over the eight neighbours, graded; edges run along the low-pass direction, so neighbours there count more.
[[nodiscard]] inline int neighbour_activity(const std::uint32_t* at, std::ptrdiff_t row, int bit, Orientation orientation) {
  const auto size = [&](std::ptrdiff_t offset) { return static_cast<int>(std::min((at[offset] & ~kSignBit) >> bit, 2u)); };
  const int beside = size(-1) + size(1), over = size(-row) + size(row);
  const int corners = size(-row - 1) + size(-row + 1) + size(row - 1) + size(row + 1);
  switch (orientation) {
    case Orientation::hl: return 2 * beside + 3 * over + corners;
    case Orientation::lh: return 3 * beside + 2 * over + corners;
    default: return 2 * beside + 2 * over + corners + (orientation == Orientation::hh ? corners / 2 : 0);
  }
}

struct SignContext {
  std::size_t index;
  bool flips;  ///< the bit sent is the sign's opposite
};

/// Signs of the four neighbours, as in EBCOT, along and across the band's high-pass direction (of hh and ll: along x).
[[nodiscard]] inline SignContext sign_context(const std::uint32_t* at, std::ptrdiff_t row, Orientation orientation) {
  const auto sign = [&](std::ptrdiff_t offset) { return at[offset] == 0 ? 0 : ((at[offset] & kSignBit) != 0 ? -1 : 1); };
  int beside = std::clamp(sign(-1) + sign(1), -1, 1), over = std::clamp(sign(-row) + sign(row), -1, 1);
  if (orientation == Orientation::lh) std::swap(beside, over);
  const bool flips = beside < 0 || (beside == 0 && over < 0);
  if (flips) {
    beside = -beside;
    over = -over;
  }
  return {static_cast<std::size_t>(beside == 0 ? over : 3 + over), flips};
}

/// First bit behind the leading one, by whether neighbours are large; later bits.
[[nodiscard]] inline std::size_t refinement_context(const std::uint32_t* at, std::ptrdiff_t row, int bit) {
  if (((at[0] & ~kSignBit) >> (bit + 1)) > 1) return 3;
  const std::uint32_t sum =
      ((at[-1] & ~kSignBit) >> bit) + ((at[1] & ~kSignBit) >> bit) + ((at[-row] & ~kSignBit) >> bit) + ((at[row] & ~kSignBit) >> bit);
  return sum == 0 ? 0 : (sum < 4 ? 1 : 2);
}

}  // namespace etalon::wavelet
