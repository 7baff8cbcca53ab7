// Is a stored channel a legal rounding of some number within a bound of the exact one?
#pragma once

#include <array>
#include <cstddef>

#include "core/draw/state.h"
#include "validation/bounds.h"

namespace etalon::validation {

/// A number and how far the device's float32 may be from it.
struct Bounded {
  double value = 0;
  double bound = 0;
};

struct StoredCheck {
  bool legal = false;
  double share = 0;  ///< of the bound that is needed to explain the stored value: 0 = it is the rounding of the exact number itself
};

/// The numbers that a correct conversion stores as this channel: an interval, closed at both ends.
struct Preimage {
  double lo = 0, hi = 0;
};

/// `channel`: index of the channel in its texel (an sRGB texel's 4th is linear).
[[nodiscard]] Preimage stored_preimage(const std::byte* stored, PixelFormat format, int channel, HalfRounding half_rounding);

/// The device converts in float32: unorm by one product, whose rounding is added to the bound (docs/bounds.md#storage).
[[nodiscard]] StoredCheck check_stored(const std::byte* stored, PixelFormat format, int channel, HalfRounding half_rounding, Bounded exact,
                                       const DeviceModel& device);

/// All channels of a texel; share is the largest.
[[nodiscard]] StoredCheck check_texel(const std::byte* stored, PixelFormat format, HalfRounding half_rounding,
                                      const std::array<Bounded, 4>& exact, const DeviceModel& device);

}  // namespace etalon::validation
