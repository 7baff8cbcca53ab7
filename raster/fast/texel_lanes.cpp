#include "raster/fast/texel_lanes.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/draw/channel_maxima.h"
#include "core/math/half.h"
#include "core/math/srgb.h"
#include "raster/storage.h"

namespace etalon::raster::fast {
namespace {

template <class T, class Decode>
void read_as(const Image& image, const IntLanes& offset, int lanes, int channel, Decode decode, DoubleLanes& result) {
  const auto* numbers = reinterpret_cast<const T*>(image.bytes().data()) + channel;
  const int channels = image.format().channels;
  for (int n = 0; n < lanes; ++n) result.at[n] = decode(numbers[static_cast<std::ptrdiff_t>(offset.at[n]) * channels]);
}

template <int kBytes>
void copy_bytes(const std::byte* from, int stride, const IntLanes& offset, int lanes, std::byte* to) {
  for (int n = 0; n < lanes; ++n) std::memcpy(to + n * kBytes, from + static_cast<std::ptrdiff_t>(offset.at[n]) * stride, kBytes);
}

template <int kChannels>
void copy_floats(const float* from, int stride, const IntLanes& offset, int lanes, std::byte* to) {
  alignas(64) float numbers[kRunLanes * kChannels];
  for (int n = 0; n < lanes; ++n)
    std::memcpy(numbers + n * kChannels, from + static_cast<std::ptrdiff_t>(offset.at[n]) * stride, kChannels * sizeof(float));
  for (int n = 0; n < lanes * kChannels; ++n) numbers[n] += 0.0f;  // −0 is stored as +0
  std::memcpy(to, numbers, static_cast<std::size_t>(lanes) * kChannels * sizeof(float));
}

template <class T, int kChannels, class Lanes>
void interleave_channels(const Lanes* channel, int lanes, std::byte* texels) {
  for (int n = 0; n < lanes; ++n) {
    T texel[kChannels];
    for (int c = 0; c < kChannels; ++c) texel[c] = static_cast<T>(channel[c].at[n]);
    std::memcpy(texels + n * sizeof texel, texel, sizeof texel);
  }
}

}  // namespace

TexelUnit texel_unit(PixelFormat format, int channel) {
  if (channel >= format.channels) return {};
  switch (format.type) {
    case ChannelType::unorm8: return {1.0 / 255, false};
    case ChannelType::srgb8: return channel == 3 ? TexelUnit{1.0 / 255, false} : TexelUnit{};
    case ChannelType::unorm16: return {1.0 / 65535, false};
    default: return {};
  }
}

void read_channel(const Image& image, const IntLanes& offset, int lanes, int channel, DoubleLanes& result) {
  if (channel >= image.format().channels) return void(std::fill_n(result.at, lanes, channel == 3 ? 1.0 : 0.0));
  const auto number = [](auto stored) { return static_cast<double>(stored); };
  switch (image.format().type) {
    case ChannelType::unorm8: return read_as<std::uint8_t>(image, offset, lanes, channel, number, result);
    case ChannelType::srgb8:
      if (channel == 3) return read_as<std::uint8_t>(image, offset, lanes, channel, number, result);
      return read_as<std::uint8_t>(
          image, offset, lanes, channel, [](std::uint8_t byte) { return double{kSrgbDecode[byte]}; }, result);
    case ChannelType::unorm16: return read_as<std::uint16_t>(image, offset, lanes, channel, number, result);
    case ChannelType::half: return read_as<std::uint16_t>(image, offset, lanes, channel, half_to_double, result);
    case ChannelType::float32: return read_as<float>(image, offset, lanes, channel, number, result);
    case ChannelType::uint32: return;
  }
}

double largest_texel(const Image& image) {
  const ChannelMaxima largest = channel_maxima(image);
  return *std::max_element(largest.begin(), largest.end());
}

bool copies(PixelFormat image, PixelFormat target) {
  return image.type == target.type && target.channels <= image.channels && image.type != ChannelType::half &&
         image.type != ChannelType::uint32;
}

void copy_texels(const Image& image, const IntLanes& offset, int lanes, PixelFormat target, const Kernels& kernels, std::byte* texels) {
  const std::byte* const from = image.bytes().data();
  if (target.type == ChannelType::float32) {
    const auto* numbers = reinterpret_cast<const float*>(from);
    if (image.format().channels == 2 && target.channels == 2) return kernels.copy_float_pairs(numbers, offset, lanes, texels);
    switch (target.channels) {
      case 1: return copy_floats<1>(numbers, image.format().channels, offset, lanes, texels);
      case 2: return copy_floats<2>(numbers, image.format().channels, offset, lanes, texels);
      case 3: return copy_floats<3>(numbers, image.format().channels, offset, lanes, texels);
      default: return copy_floats<4>(numbers, image.format().channels, offset, lanes, texels);
    }
  }
  const int stride = bytes_per_texel(image.format());
  if (stride == 4 && bytes_per_texel(target) == 4)
    return kernels.copy_words(reinterpret_cast<const std::uint32_t*>(from), offset, lanes, texels);
  switch (bytes_per_texel(target)) {
    case 1: return copy_bytes<1>(from, stride, offset, lanes, texels);
    case 2: return copy_bytes<2>(from, stride, offset, lanes, texels);
    case 3: return copy_bytes<3>(from, stride, offset, lanes, texels);
    case 4: return copy_bytes<4>(from, stride, offset, lanes, texels);
    case 6: return copy_bytes<6>(from, stride, offset, lanes, texels);
    default: return copy_bytes<8>(from, stride, offset, lanes, texels);
  }
}

template <class T, class Lanes>
void interleave(const Lanes* channel, int lanes, int channels, std::byte* texels) {
  switch (channels) {
    case 1: return interleave_channels<T, 1>(channel, lanes, texels);
    case 2: return interleave_channels<T, 2>(channel, lanes, texels);
    case 3: return interleave_channels<T, 3>(channel, lanes, texels);
    default: return interleave_channels<T, 4>(channel, lanes, texels);
  }
}
template void interleave<std::uint8_t>(const IntLanes*, int, int, std::byte*);
template void interleave<std::uint16_t>(const IntLanes*, int, int, std::byte*);
template void interleave<float>(const FloatLanes*, int, int, std::byte*);

LaneMask store_lanes(const Values* value, int lanes, const TargetSpec& target, HalfRounding rounding, std::byte* texels) {
  const int size = bytes_per_channel(target.format.type);
  LaneMask undecided = 0;
  for (int c = 0; c < target.format.channels; ++c) {
    const ChannelStore store{target.format.type, c == 3, rounding};
    for (int n = 0; n < lanes; ++n) {
      const double v = value[c].value.at[n], error = value[c].error.at[n];
      if (!store.try_store({v - error, v + error}, texels + (n * target.format.channels + c) * size)) undecided |= LaneMask{1} << n;
    }
  }
  return undecided;
}

}  // namespace etalon::raster::fast
