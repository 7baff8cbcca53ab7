// What encoder and decoder both know about one subband of one channel while its bit-planes go by, and the quadtree of blocks over it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/wavelet/delays.h"
#include "core/wavelet/subbands.h"

namespace etalon::wavelet {

inline constexpr std::uint32_t kSignBit = 0x80000000u;
inline constexpr std::int16_t kNoPlane = std::numeric_limits<std::int16_t>::min();

/// A place in a grid of at most 32768²: y·2^16 + x.
using Place = std::uint32_t;
[[nodiscard]] constexpr Place make_place(int x, int y) { return (static_cast<Place>(y) << 16) | static_cast<Place>(x); }
[[nodiscard]] constexpr int place_x(Place p) { return static_cast<int>(p & 0xFFFF); }
[[nodiscard]] constexpr int place_y(Place p) { return static_cast<int>(p >> 16); }

/// Blocks of 2^k × 2^k coefficients, with a border of one so that every block has eight neighbours.
struct BlockGrid {
  int width = 0, height = 0;
  std::vector<std::uint8_t> is_significant;  ///< bordered; not for single coefficients, whose `known` says it
  std::vector<std::int16_t> first_plane;     ///< of delayed coefficients only: plane at which the first of them can become significant
  std::vector<std::int16_t> last_plane;      ///< and the one after which none of them has bits left
  std::vector<std::int16_t> top_plane;       ///< encoder only: plane at which the block becomes significant, kNoPlane: never

  [[nodiscard]] std::size_t index(Place p) const {
    return static_cast<std::size_t>(place_y(p)) * static_cast<std::size_t>(width) + static_cast<std::size_t>(place_x(p));
  }
  [[nodiscard]] std::ptrdiff_t stride() const { return width + 2; }
  [[nodiscard]] std::size_t bordered(Place p) const {
    return static_cast<std::size_t>(place_y(p) + 1) * static_cast<std::size_t>(stride()) + static_cast<std::size_t>(place_x(p) + 1);
  }
  [[nodiscard]] std::size_t bordered_size() const { return static_cast<std::size_t>(stride()) * static_cast<std::size_t>(height + 2); }
};

/// A block that waits for the plane at which it can become significant.
struct Waiting {
  std::uint8_t depth;
  Place place;
};

struct BandState {
  Subband band;
  int channel = 0;
  double gain = 1;                       ///< norm in RGB of a unit of the coded integers
  int planes = 0;                        ///< magnitudes are below 2^planes
  int first_plane = 0;                   ///< of all coefficients: planes − 1 without delays
  int last_plane = 0;                    ///< 0 without delays
  const BandState* parent = nullptr;     ///< same channel and orientation, one level coarser
  const BandState* luma = nullptr;       ///< of a colour channel: the same band of channel 0
  int parent_shift = 0, luma_shift = 0;  ///< planes by which their units weigh more than ours, rounded

  std::vector<BlockGrid> grids;           ///< [0]: single coefficients
  std::vector<std::uint32_t> known;       ///< bordered; magnitude as far as sent, kSignBit: negative; 0: not yet significant
  std::vector<std::uint8_t> known_plane;  ///< lowest bit sent of a significant coefficient
  std::vector<std::int16_t> delays;       ///< of single coefficients; empty: 0

  std::vector<std::vector<Place>> pending;  ///< [depth]: insignificant blocks that can become significant at the next plane
  std::vector<std::vector<Waiting>> wakes;  ///< [plane − last_plane], of delayed coefficients only
  std::vector<Place> significant;           ///< coefficients with bits to come, in the order of their appearance
  std::size_t refinable = 0;                ///< how many of them were significant before the current plane

  [[nodiscard]] int delay(Place p) const { return delays.empty() ? 0 : delays[grids[0].index(p)]; }
  [[nodiscard]] bool is_delayed() const { return !delays.empty(); }
};

/// A band with its quadtree, nothing known yet; `planes` and gain set, delays cut from the whole plane's.
[[nodiscard]] BandState make_band_state(const Subband& band, int channel, double gain, int planes, const Delays& delays);

/// All bands of all channels, channel by channel, coarse to fine, linked; `top_exponent` bounds magnitude·gain below 2^top_exponent.
[[nodiscard]] std::vector<BandState> make_band_states(const std::vector<Subband>& bands, const std::vector<double>& gains, int channels,
                                                      int top_exponent, const Delays& delays);

/// The passes of a stream in their order: by the distortion gain·2^plane that a unit of the plane stands for; of equal ones those that find what
/// is significant before those that refine what was.
struct Pass {
  std::uint32_t band;
  std::int16_t plane;
  bool refines;
};
[[nodiscard]] std::vector<Pass> make_passes(const std::vector<BandState>& bands);

}  // namespace etalon::wavelet
