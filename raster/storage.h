// Storing exact numbers into targets: one rounding, directly to the target's format (docs/contract.md#storage).
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/draw/state.h"
#include "core/math/quotient.h"
#include "raster/texture.h"

namespace etalon::raster {

/// Where one channel of one texel goes.
struct ChannelStore {
  ChannelType type = ChannelType::unorm8;
  bool alpha = false;  ///< channel 3: linear also in srgb8
  HalfRounding half_rounding = HalfRounding::nearest_even;

  /// Stores the number if every number of the interval is stored alike; otherwise writes nothing and returns false.
  [[nodiscard]] bool try_store(Interval v, std::byte* channel) const;
  /// Stores any float32 (clears, pass-through values): always decidable.
  void store(const TexelValue& value, std::byte* channel) const;
  template <int kLimbs>
  void store_exact(const Quotient<kLimbs>& q, std::byte* channel) const;
};

extern template void ChannelStore::store_exact(const Quotient<4>&, std::byte*) const;
extern template void ChannelStore::store_exact(const Quotient<8>&, std::byte*) const;
extern template void ChannelStore::store_exact(const Quotient<16>&, std::byte*) const;

}  // namespace etalon::raster
