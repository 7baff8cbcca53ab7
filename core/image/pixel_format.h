// What one texel holds: a channel type and 1 to 4 channels.
#pragma once

#include <cstdint>
#include <string>

namespace etalon {

enum class ChannelType : std::uint8_t {
  unorm8,   ///< stored byte i means the rational i/255
  srgb8,    ///< colour channels hold the sRGB curve (docs/contract.md#srgb), a 4th channel is unorm8
  unorm16,  ///< stored i means i/65535
  half,     ///< IEEE binary16
  float32,  ///< IEEE binary32
  uint32,   ///< integer, never filtered (ids)
};

struct PixelFormat {
  ChannelType type = ChannelType::unorm8;
  int channels = 4;  ///< 1..4: R, RG, RGB, RGBA
  friend bool operator==(const PixelFormat&, const PixelFormat&) = default;
};

inline constexpr PixelFormat kRgba8{ChannelType::unorm8, 4};
inline constexpr PixelFormat kRgb8{ChannelType::unorm8, 3};
inline constexpr PixelFormat kRg32f{ChannelType::float32, 2};
inline constexpr PixelFormat kR32f{ChannelType::float32, 1};
inline constexpr PixelFormat kRgba32f{ChannelType::float32, 4};
inline constexpr PixelFormat kR32ui{ChannelType::uint32, 1};

[[nodiscard]] constexpr int bytes_per_channel(ChannelType type) {
  switch (type) {
    case ChannelType::unorm8:
    case ChannelType::srgb8: return 1;
    case ChannelType::unorm16:
    case ChannelType::half: return 2;
    case ChannelType::float32:
    case ChannelType::uint32: return 4;
  }
  return 0;
}

[[nodiscard]] constexpr int bytes_per_texel(PixelFormat format) { return bytes_per_channel(format.type) * format.channels; }

/// "rgba unorm8", "r uint32": for messages and reports.
[[nodiscard]] std::string to_string(PixelFormat format);
[[nodiscard]] std::string to_string(ChannelType type);

}  // namespace etalon
