#include "validation/reference/integer_lookup.h"

#include <algorithm>

#include "validation/reference/srgb_table.h"
#include "validation/reference/stored_number.h"

namespace etalon::validation::reference {

namespace {

// Filtered float texels are multiples of 2^-63: 24 bits, and not below 2^-40.
constexpr unsigned kFilteredBits = 63;

std::int64_t euclidean_mod(std::int64_t a, std::int64_t n) { return ((a % n) + n) % n; }

// "Each index is wrapped on its own: clamp min/max; repeat i mod n (Euclidean); mirrored (n−1) − m((i mod 2n) − n),
// m(a) = a ≥ 0 ? a : −(1+a)."
int wrapped(const BigInt& index, int size, Wrap wrap) {
  const auto i = index.convert_to<std::int64_t>();
  const std::int64_t n = size;
  switch (wrap) {
    case Wrap::clamp: return static_cast<int>(std::min(std::max<std::int64_t>(i, 0), n - 1));
    case Wrap::repeat: return static_cast<int>(euclidean_mod(i, n));
    case Wrap::mirrored_repeat: {
      const std::int64_t a = euclidean_mod(i, 2 * n) - n;
      return static_cast<int>((n - 1) - (a >= 0 ? a : -(1 + a)));
    }
  }
  return 0;
}

// "Texel values are exact: unorm i/255, i/65535; srgb8 decoded by a table of 256 float32 (4th channel unorm). Absent channels read
// 0, 0, 1."
Fraction texel_value(const Image& image, int x, int y, int channel) {
  if (channel >= image.format().channels) return {channel == 3 ? 1 : 0, 1};
  switch (image.format().type) {
    case ChannelType::unorm8: return {image.channels<std::uint8_t>(x, y)[channel], 255};
    case ChannelType::srgb8: {
      const std::uint8_t stored = image.channels<std::uint8_t>(x, y)[channel];
      return channel == 3 ? Fraction{stored, 255} : exact(srgb_decode()[stored]);
    }
    case ChannelType::unorm16: return {image.channels<std::uint16_t>(x, y)[channel], 65535};
    case ChannelType::half: {
      const Binary b = binary_of_half(image.channels<std::uint16_t>(x, y)[channel]);
      return b.e >= 0 ? Fraction{BigInt(b.m) << b.e, 1} : Fraction{b.m, BigInt(1) << -b.e};
    }
    case ChannelType::float32: return exact(image.channels<float>(x, y)[channel]);
    case ChannelType::uint32: break;
  }
  throw_check_failed(__FILE__, __LINE__, "a texture holds numbers", to_string(image.format()));
}

// A channel of a texel that is filtered, over the denominator that all texels of the image share in this channel.
// "a texel that is filtered, with |a| < 2^-40 enters as +0" (a half below that is 0 anyway)
BigInt filtered_denominator(PixelFormat format, int channel) {
  if (channel >= format.channels) return 1;
  switch (format.type) {
    case ChannelType::unorm8: return 255;
    case ChannelType::unorm16: return 65535;
    case ChannelType::srgb8: return channel == 3 ? BigInt(255) : BigInt(1) << kFilteredBits;
    default: return BigInt(1) << kFilteredBits;
  }
}
BigInt filtered_numerator(const Image& image, int x, int y, int channel) {
  if (channel >= image.format().channels) return channel == 3 ? 1 : 0;
  switch (image.format().type) {
    case ChannelType::unorm8: return image.channels<std::uint8_t>(x, y)[channel];
    case ChannelType::unorm16: return image.channels<std::uint16_t>(x, y)[channel];
    case ChannelType::srgb8: {
      const std::uint8_t stored = image.channels<std::uint8_t>(x, y)[channel];
      return channel == 3 ? BigInt(stored) : fixed_point(srgb_decode()[stored], kFilteredBits);
    }
    case ChannelType::half: {
      const Binary b = binary_of_half(image.channels<std::uint16_t>(x, y)[channel]);
      return BigInt(b.m) << (b.e + static_cast<int>(kFilteredBits));
    }
    case ChannelType::float32: return fixed_point(as_input(image.channels<float>(x, y)[channel]), kFilteredBits);
    case ChannelType::uint32: break;
  }
  throw_check_failed(__FILE__, __LINE__, "a texture holds numbers", to_string(image.format()));
}

// "nearest: i = floor(u·n)"
std::array<Fraction, 4> look_up_nearest(const Image& image, const Sampler& sampler, const TextureCoordinate& uv) {
  const int x = wrapped(floor_div(uv.u.n * image.width(), uv.u.d), image.width(), sampler.wrap_u);
  const int y = wrapped(floor_div(uv.v.n * image.height(), uv.v.d), image.height(), sampler.wrap_v);
  return {texel_value(image, x, y, 0), texel_value(image, x, y, 1), texel_value(image, x, y, 2), texel_value(image, x, y, 3)};
}

// "Linear: i0 = floor(u·n − ½), f = u·n − ½ − i0, i1 = i0 + 1."
struct LinearIndex {
  int i0;
  int i1;
  BigInt f;           // numerator of f
  BigInt complement;  // numerator of 1 − f
  BigInt denominator;
};
LinearIndex linear_index(const Fraction& u, int size, Wrap wrap) {
  const BigInt denominator = 2 * u.d;
  const BigInt numerator = 2 * u.n * size - u.d;  // (u·n − ½) · denominator
  const BigInt i0 = floor_div(numerator, denominator);
  const BigInt f = numerator - i0 * denominator;
  return {wrapped(i0, size, wrap), wrapped(i0 + 1, size, wrap), f, denominator - f, denominator};
}

// "Linear value = (1−f)(1−g)t00 + f(1−g)t10 + (1−f)g·t01 + f·g·t11."
std::array<Fraction, 4> look_up_linear(const Image& image, const Sampler& sampler, const TextureCoordinate& uv) {
  const LinearIndex x = linear_index(uv.u, image.width(), sampler.wrap_u);
  const LinearIndex y = linear_index(uv.v, image.height(), sampler.wrap_v);
  const BigInt w00 = x.complement * y.complement, w10 = x.f * y.complement, w01 = x.complement * y.f, w11 = x.f * y.f;
  const BigInt denominator = x.denominator * y.denominator;
  std::array<Fraction, 4> value;
  for (int c = 0; c < 4; ++c) {
    const auto texel = [&](int i, int j) { return filtered_numerator(image, i, j, c); };
    value[static_cast<std::size_t>(c)] = {
        w00 * texel(x.i0, y.i0) + w10 * texel(x.i1, y.i0) + w01 * texel(x.i0, y.i1) + w11 * texel(x.i1, y.i1),
        denominator * filtered_denominator(image.format(), c)};
  }
  return value;
}

}  // namespace

std::array<Fraction, 4> look_up(const Image& image, const Sampler& sampler, const TextureCoordinate& uv) {
  return sampler.filter == Filter::nearest ? look_up_nearest(image, sampler, uv) : look_up_linear(image, sampler, uv);
}

TextureCoordinate look_up_coordinate(const Image& map, const Sampler& sampler, const TextureCoordinate& uv) {
  const std::array<Fraction, 4> value = look_up(map, sampler, uv);
  // "exactly the stored number under nearest, rounded once to float32 (then canonical) under linear"
  if (sampler.filter == Filter::nearest) return {value[0], value[1]};
  return {exact(as_input(round_to_float32(value[0]))), exact(as_input(round_to_float32(value[1])))};
}

}  // namespace etalon::validation::reference
