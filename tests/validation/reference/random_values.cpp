#include "tests/validation/reference/random_values.h"

#include <algorithm>

namespace etalon::validation::reference {

namespace {

float signed_at_random(Rng& rng, float magnitude) { return rng.coin() ? magnitude : -magnitude; }

// Any half of at most 2^limit_exponent.
std::uint16_t random_half(Rng& rng, int limit_exponent) {
  const std::uint64_t limit = limit_exponent > 15 ? 0x7BFF : static_cast<std::uint64_t>(limit_exponent + 15) << 10;  // 65504, 2^limit
  return static_cast<std::uint16_t>(rng.below(limit + 1) | (rng.coin() ? 0x8000u : 0u));
}

float random_texel(Rng& rng, int limit_exponent, bool wild) {
  if (!wild) return rng.uniform(-0.25f, 1.25f);
  switch (rng.below(6)) {
    case 0: return signed_at_random(rng, log_uniform(rng, -149, -126));  // subnormal: the mantissa is cut to what is left
    case 1: return signed_at_random(rng, log_uniform(rng, -44, -36));
    case 2: return -0.0f;
    case 3: return static_cast<float>(rng.between(0, 255)) * 0x1p-8f;
    case 4: return signed_at_random(rng, std::ldexp(1.0f, limit_exponent));
    default: return signed_at_random(rng, log_uniform(rng, -40, limit_exponent));
  }
}

}  // namespace

float random_attribute(Rng& rng, int limit_exponent) {
  switch (rng.below(11)) {
    case 0: return 0.0f;
    case 10:  // where half and unorm change their mind: overflow, the middle of subnormals, 1
      return std::min(one_of(rng, {65504.0f, 65519.996f, 65520.0f, 65536.0f, -65520.0f, 0x1p-25f, -0x1p-25f, 0x1.8p-24f, 0x1.fffffep-1f,
                                   1.0f, 0x1.002p0f}),
                      std::ldexp(1.0f, limit_exponent));
    case 1: return one_of(rng, {-0.0f, 1.0f, 0.5f, 0x1p-40f, 0x1.fffffep-41f, -0x1p-41f, 0x1p-149f});
    case 2: return static_cast<float>(rng.between(0, 256)) * 0x1p-8f;
    case 3: return static_cast<float>(rng.between(0, 255)) / 255.0f;
    case 4: return signed_at_random(rng, log_uniform(rng, -42, limit_exponent));
    case 5:
      return signed_at_random(rng,
                              one_in(rng, 2) ? std::ldexp(1.0f, limit_exponent) : log_uniform(rng, limit_exponent - 3, limit_exponent));
    case 6: return rng.uniform(-4.0f, 4.0f);
    default: return rng.uniform(0.0f, 1.0f);
  }
}

RasterState random_state(Rng& rng) {
  RasterState state;
  state.subtexel_bits = one_in(rng, 3) ? 8 : static_cast<int>(rng.between(1, 16));
  state.snap = one_of(
      rng, {SnapRounding::nearest_even, SnapRounding::half_up, SnapRounding::half_away, SnapRounding::toward_zero, SnapRounding::floor});
  state.fill_rule = one_of(rng, {FillRule::left_ymin, FillRule::left_ymax, FillRule::right_ymin, FillRule::right_ymax});
  state.half_rounding = rng.coin() ? HalfRounding::nearest_even : HalfRounding::toward_zero;
  state.cull = one_in(rng, 4) ? one_of(rng, {CullMode::clockwise, CullMode::counter_clockwise}) : CullMode::none;
  state.depth_test = rng.coin();
  return state;
}

PixelFormat random_format(Rng& rng, int channels) {
  return {one_of(rng, {ChannelType::unorm8, ChannelType::srgb8, ChannelType::unorm16, ChannelType::half, ChannelType::float32}), channels};
}

Sampler random_sampler(Rng& rng) {
  const auto wrap = [&rng] { return one_of(rng, {Wrap::clamp, Wrap::repeat, Wrap::mirrored_repeat}); };
  const Wrap u = wrap(), v = wrap();
  return {rng.coin() ? Filter::nearest : Filter::linear, u, v};
}

std::shared_ptr<const Image> random_image(Rng& rng, PixelFormat format, int limit_exponent) {
  const auto side = [&rng] { return rng.coin() ? 1 << rng.below(7) : static_cast<int>(rng.between(1, 64)); };
  const int width = side(), height = side();
  const bool wild = one_in(rng, 4);
  auto image = std::make_shared<Image>(width, height, format);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < format.channels; ++c) switch (format.type) {
          case ChannelType::unorm8:
          case ChannelType::srgb8: image->channels<std::uint8_t>(x, y)[c] = static_cast<std::uint8_t>(rng.next()); break;
          case ChannelType::unorm16: image->channels<std::uint16_t>(x, y)[c] = static_cast<std::uint16_t>(rng.next()); break;
          case ChannelType::half: image->channels<std::uint16_t>(x, y)[c] = random_half(rng, wild ? limit_exponent : 0); break;
          case ChannelType::float32: image->channels<float>(x, y)[c] = random_texel(rng, limit_exponent, wild); break;
          case ChannelType::uint32: image->channels<std::uint32_t>(x, y)[c] = static_cast<std::uint32_t>(rng.next()); break;
        }
  return image;
}

}  // namespace etalon::validation::reference
