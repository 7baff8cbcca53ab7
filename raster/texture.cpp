#include "raster/texture.h"

#include <algorithm>
#include <bit>

#include "core/draw/draw_list.h"
#include "core/math/quotient.h"
#include "core/math/srgb.h"

namespace etalon::raster {

double TexelValue::approximate() const { return scaled(static_cast<double>(m), e) / den; }

TexelValue exact_number(float value) {
  if (value == 0) return {};
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  const auto biased = static_cast<int>(bits >> 23 & 0xFF);
  std::int64_t m = bits & 0x7FFFFF;
  if (biased != 0) m |= 0x800000;
  const int trailing = std::countr_zero(static_cast<std::uint64_t>(m));
  m >>= trailing;
  return {(bits >> 31) != 0 ? -m : m, std::max(biased, 1) - 150 + trailing, 1};
}

TexelValue texel_value(const Image& image, int x, int y, int c, bool filtered) {
  const PixelFormat format = image.format();
  if (c >= format.channels) return {c == 3 ? 1 : 0, 0, 1};
  const auto number = [filtered](float value) { return exact_number(filtered ? canonical(value) : value); };
  switch (format.type) {
    case ChannelType::unorm8: return {image.channels<std::uint8_t>(x, y)[c], 0, 255};
    case ChannelType::srgb8: {
      const std::uint8_t byte = image.channels<std::uint8_t>(x, y)[c];
      return c == 3 ? TexelValue{byte, 0, 255} : exact_number(kSrgbDecode[byte]);
    }
    case ChannelType::unorm16: return {image.channels<std::uint16_t>(x, y)[c], 0, 65535};
    case ChannelType::half: return number(static_cast<float>(half_to_double(image.channels<std::uint16_t>(x, y)[c])));
    case ChannelType::float32: return number(image.channels<float>(x, y)[c]);
    case ChannelType::uint32: return {image.channels<std::uint32_t>(x, y)[c], 0, 1};
  }
  return {};
}

int wrapped(std::int64_t i, int size, Wrap wrap) {
  const std::int64_t n = size;
  switch (wrap) {
    case Wrap::clamp: return static_cast<int>(std::clamp<std::int64_t>(i, 0, n - 1));
    case Wrap::repeat: return static_cast<int>((i % n + n) % n);
    case Wrap::mirrored_repeat: {
      const std::int64_t a = (i % (2 * n) + 2 * n) % (2 * n) - n;
      return static_cast<int>((n - 1) - (a >= 0 ? a : -(1 + a)));
    }
  }
  return 0;
}

int filtered_texel_bits(ChannelType type) {
  switch (type) {
    case ChannelType::unorm8: return 8;
    case ChannelType::unorm16: return 16;
    case ChannelType::half: return 41;      // 65504 down to the 2^-24 of a subnormal
    case ChannelType::srgb8: return 40;     // 1 down to 2^-35: the least entry, 1/255/12.92, is above 2^-12 with 24 bits
    case ChannelType::float32: return 104;  // 2^40 down to the last bit of 2^-40, 2^-63
    case ChannelType::uint32: return 32;
  }
  return 104;
}

}  // namespace etalon::raster
