#include "validation/verify/pictures.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "validation/metrics/image_difference.h"

namespace etalon::validation {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

constexpr Rgb kBackdrop{24, 26, 32};

std::uint8_t byte_of(double value) {
  if (!(value > 0)) return 0;  // NaN too
  return static_cast<std::uint8_t>(std::min(value, 1.0) * 255.0 + 0.5);
}

// A stored channel as a number in [0, 1] (floats: as they are).
double channel_value(const Image& image, int x, int y, int c) {
  switch (image.format().type) {
    case ChannelType::unorm8:
    case ChannelType::srgb8: return image.channels<std::uint8_t>(x, y)[c] / 255.0;
    case ChannelType::unorm16: return image.channels<std::uint16_t>(x, y)[c] / 65535.0;
    case ChannelType::half: return half_value(image.channels<std::uint16_t>(x, y)[c]);
    case ChannelType::float32: return image.channels<float>(x, y)[c];
    case ChannelType::uint32: return image.channels<std::uint32_t>(x, y)[c];
  }
  return 0;
}

Rgb id_color(std::uint32_t id) {
  if (id == 0xFFFFFFFFu) return kBackdrop;
  std::uint32_t h = id * 0x9E3779B1u;  // multiplicative hash: neighbours in the list get unlike colours
  h ^= h >> 15;
  h *= 0x85EBCA77u;
  h ^= h >> 13;
  return {static_cast<std::uint8_t>(72 + (h & 0xFF) * 160 / 255), static_cast<std::uint8_t>(72 + ((h >> 8) & 0xFF) * 160 / 255),
          static_cast<std::uint8_t>(72 + ((h >> 16) & 0xFF) * 160 / 255)};
}

Rgb picture_texel(const Image& image, int x, int y, float low, float high) {
  if (image.format().type == ChannelType::uint32) return id_color(*image.channels<std::uint32_t>(x, y));
  if (image.format().channels == 1) {
    const double value = channel_value(image, x, y, 0);
    if (image.format().type != ChannelType::float32) {
      const std::uint8_t grey = byte_of(value);
      return {grey, grey, grey};
    }
    if (value >= 1.0) return kBackdrop;  // the clear depth
    const std::uint8_t grey = byte_of(high > low ? 0.95 - 0.8 * (value - low) / (static_cast<double>(high) - low) : 0.95);
    return {grey, grey, grey};
  }
  Rgb rgb{0, 0, 0};
  for (int c = 0; c < std::min(image.format().channels, 3); ++c) rgb[static_cast<std::size_t>(c)] = byte_of(channel_value(image, x, y, c));
  return rgb;
}

void put(Image& picture, int x, int y, const Rgb& rgb) { std::memcpy(picture.texel(x, y), rgb.data(), 3); }

// The largest byte of an R unorm8 image within `reach` texels, so that a lone texel can be seen.
std::uint8_t dilated(const Image& field, int x, int y, int reach) {
  std::uint8_t largest = 0;
  for (int v = std::max(y - reach, 0); v <= std::min(y + reach, field.height() - 1); ++v) {
    for (int u = std::max(x - reach, 0); u <= std::min(x + reach, field.width() - 1); ++u) {
      largest = std::max(largest, *field.channels<std::uint8_t>(u, v));
    }
  }
  return largest;
}

// Bits needed to write the difference in stored units; 0 where equal.
std::uint8_t error_level(const Image& a, const Image& b, int x, int y) {
  const std::size_t size = static_cast<std::size_t>(bytes_per_texel(a.format()));
  if (std::memcmp(a.texel(x, y), b.texel(x, y), size) == 0) return 0;
  std::uint64_t largest = 1;
  for (int c = 0; c < a.format().channels; ++c) {
    std::uint64_t d = 0;
    switch (a.format().type) {
      case ChannelType::unorm8:
      case ChannelType::srgb8:
        d = static_cast<std::uint64_t>(std::abs(a.channels<std::uint8_t>(x, y)[c] - b.channels<std::uint8_t>(x, y)[c]));
        break;
      case ChannelType::unorm16:
      case ChannelType::half:
        d = static_cast<std::uint64_t>(std::abs(a.channels<std::uint16_t>(x, y)[c] - b.channels<std::uint16_t>(x, y)[c]));
        break;
      case ChannelType::float32: {
        const auto p = std::int64_t{std::bit_cast<std::int32_t>(a.channels<float>(x, y)[c])};
        const auto q = std::int64_t{std::bit_cast<std::int32_t>(b.channels<float>(x, y)[c])};
        d = static_cast<std::uint64_t>(std::abs(p - q));
        break;
      }
      case ChannelType::uint32: d = 255; break;
    }
    largest = std::max(largest, d);
  }
  return static_cast<std::uint8_t>(std::bit_width(largest));
}

// Dark violet over magenta and orange to pale yellow, in equal steps of `t` from 0 to 1.
Rgb heat(double t) {
  constexpr std::array<Rgb, 5> stops{{{76, 36, 130}, {158, 47, 127}, {228, 79, 90}, {252, 162, 76}, {252, 253, 191}}};
  const double at = std::clamp(t, 0.0, 1.0) * 4.0;
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(at), 3);
  const double f = at - static_cast<double>(i);
  Rgb rgb{};
  for (std::size_t c = 0; c < 3; ++c) rgb[c] = static_cast<std::uint8_t>(stops[i][c] + f * (stops[i + 1][c] - stops[i][c]) + 0.5);
  return rgb;
}

}  // namespace

std::array<std::uint8_t, 3> class_color(TexelClass value) {
  switch (value) {
    case TexelClass::identical: return {110, 120, 135};
    case TexelClass::rounding: return {86, 180, 233};
    case TexelClass::tie: return {230, 159, 0};
    case TexelClass::unbounded: return {204, 121, 167};
    case TexelClass::unexplained: return {255, 45, 45};
  }
  return {0, 0, 0};
}

Image picture_of(const Image& image, float low, float high) {
  Image picture(image.width(), image.height(), kRgb8);
  parallel_for(static_cast<std::size_t>(image.height()), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < image.width(); ++x) put(picture, x, y, picture_texel(image, x, y, low, high));
  });
  return picture;
}

ValueRange drawn_range(const Image& depth) {
  ETALON_CHECK(depth.format() == kR32f, to_string(depth.format()));
  float low = 2;
  float high = -1;
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      const float value = *depth.channels<float>(x, y);
      if (!(value < 1)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (low > high) return {};
  return {low, high};
}

Image class_picture(const Image& picture, const Image& classes, int reach) {
  ETALON_CHECK(picture.width() == classes.width() && picture.height() == classes.height(), "sizes differ");
  constexpr auto kRounding = static_cast<std::uint8_t>(TexelClass::rounding);
  Image result(picture.width(), picture.height(), kRgb8);
  parallel_for(static_cast<std::size_t>(picture.height()), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < picture.width(); ++x) {
      const auto* rgb = picture.channels<std::uint8_t>(x, y);
      const int luma = (54 * rgb[0] + 183 * rgb[1] + 19 * rgb[2]) >> 8;
      const int grey = 20 + luma * 5 / 16;
      const std::uint8_t worst = dilated(classes, x, y, reach);
      if (worst > kRounding) {
        put(result, x, y, class_color(static_cast<TexelClass>(worst)));
      } else if (*classes.channels<std::uint8_t>(x, y) == kRounding) {
        const Rgb tint = class_color(TexelClass::rounding);
        Rgb mixed{};
        for (std::size_t c = 0; c < 3; ++c) mixed[c] = static_cast<std::uint8_t>((6 * tint[c] * (luma + 112) / 368 + 2 * grey) / 8);
        put(result, x, y, mixed);
      } else {
        put(result, x, y, {static_cast<std::uint8_t>(grey), static_cast<std::uint8_t>(grey), static_cast<std::uint8_t>(grey + 4)});
      }
    }
  });
  return result;
}

Image error_picture(const Image& a, const Image& b, int reach) {
  ETALON_CHECK(a.width() == b.width() && a.height() == b.height() && a.format() == b.format(), "images not comparable");
  const bool bytes = a.format().type == ChannelType::unorm8 || a.format().type == ChannelType::srgb8;
  const double widest = bytes ? 8.0 : a.format().type == ChannelType::uint32 ? 8.0 : 16.0;
  Image levels(a.width(), a.height(), {ChannelType::unorm8, 1});
  parallel_for(static_cast<std::size_t>(a.height()), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < a.width(); ++x) *levels.channels<std::uint8_t>(x, y) = error_level(a, b, x, y);
  });
  Image result(a.width(), a.height(), kRgb8);
  parallel_for(static_cast<std::size_t>(a.height()), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < a.width(); ++x) {
      const std::uint8_t level = dilated(levels, x, y, reach);
      put(result, x, y, level == 0 ? Rgb{10, 9, 16} : heat((level - 1) / (widest - 1)));
    }
  });
  return result;
}

Image reduced(const Image& picture, int limit_px) {
  const int step = (std::max(picture.width(), picture.height()) + limit_px - 1) / limit_px;
  if (step <= 1) return picture;
  const int width = (picture.width() + step - 1) / step;
  const int height = (picture.height() + step - 1) / step;
  Image result(width, height, picture.format());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::memcpy(result.texel(x, y), picture.texel(x * step, y * step), static_cast<std::size_t>(bytes_per_texel(picture.format())));
    }
  }
  return result;
}

Image crop(const Image& picture, int x, int y, int size) {
  Image result(size, size, kRgb8);
  for (int v = 0; v < size; ++v) {
    for (int u = 0; u < size; ++u) {
      const int px = x + u - size / 2;
      const int py = y + v - size / 2;
      const bool inside = px >= 0 && py >= 0 && px < picture.width() && py < picture.height();
      if (inside)
        std::memcpy(result.texel(u, v), picture.texel(px, py), 3);
      else
        put(result, u, v, {128, 128, 128});
    }
  }
  return result;
}

}  // namespace etalon::validation
