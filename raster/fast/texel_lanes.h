// Texels of images, by lanes: reading channels as numbers, copying, and the stores that have no vector kernel.
#pragma once

#include "core/draw/state.h"
#include "core/image/image.h"
#include "raster/fast/kernels.h"

namespace etalon::raster::fast {

/// What read_channel()'s numbers are worth: value = number · scale. `exact` where scale is 1.
struct TexelUnit {
  double scale = 1;
  bool exact = true;
};
[[nodiscard]] TexelUnit texel_unit(PixelFormat format, int channel);

/// Channel c of the texels at the offsets; absent channels are 0, 0, 1.
void read_channel(const Image& image, const IntLanes& offset, int lanes, int channel, DoubleLanes& result);

/// Largest magnitude of an image's numbers; 1 for bounded formats.
[[nodiscard]] double largest_texel(const Image& image);

/// Whether a nearest lookup's texel goes into the target channel by channel, without arithmetic.
[[nodiscard]] bool copies(PixelFormat image, PixelFormat target);
void copy_texels(const Image& image, const IntLanes& offset, int lanes, PixelFormat target, const Kernels& kernels, std::byte* texels);

/// Channels side by side.
template <class T, class Lanes>
void interleave(const Lanes* channel, int lanes, int channels, std::byte* texels);

/// Any format by ChannelStore::try_store.
[[nodiscard]] LaneMask store_lanes(const Values* value, int lanes, const TargetSpec& target, HalfRounding rounding, std::byte* texels);

extern template void interleave<std::uint8_t>(const IntLanes*, int, int, std::byte*);
extern template void interleave<std::uint16_t>(const IntLanes*, int, int, std::byte*);
extern template void interleave<float>(const FloatLanes*, int, int, std::byte*);

}  // namespace etalon::raster::fast
