#include "validation/texel_lookup.h"

#include <algorithm>

#include "core/math/half.h"
#include "core/math/srgb.h"

namespace etalon::validation {

namespace {

constexpr double kAbsent[4] = {0, 0, 0, 1};

bool is_power_of_two(int n) { return (n & (n - 1)) == 0; }

int byte_of(const Image& image, int i, int j, int c) { return image.channels<std::uint8_t>(i, j)[c]; }

// Two bytes at weight w/256 as gallivm's 16-bit lanes combine them (lp_build_lerp_simple): v0 + (w·(v1 − v0) >> 8), rounded by pmulhrsw or not.
int lerp8(int w, int v0, int v1, bool truncating) {
  const int product = w * (v1 - v0);
  return (v0 + ((product + (truncating ? 0 : 128)) >> 8)) & 255;
}

}  // namespace

double texel_value(const Image& image, int i, int j, int c) {
  if (c >= image.format().channels) return kAbsent[c];
  switch (image.format().type) {
    case ChannelType::unorm8: return image.channels<std::uint8_t>(i, j)[c] / 255.0;
    case ChannelType::srgb8: {
      const std::uint8_t code = image.channels<std::uint8_t>(i, j)[c];
      return c == 3 ? code / 255.0 : static_cast<double>(kSrgbDecode[code]);
    }
    case ChannelType::unorm16: return image.channels<std::uint16_t>(i, j)[c] / 65535.0;
    case ChannelType::half: return half_to_double(image.channels<std::uint16_t>(i, j)[c]);
    case ChannelType::float32: return static_cast<double>(image.channels<float>(i, j)[c]);
    case ChannelType::uint32: return image.channels<std::uint32_t>(i, j)[c];
  }
  return 0;
}

Bounded device_texel(const Image& image, int i, int j, int c, const DeviceModel& device) {
  const double value = texel_value(image, i, j, c);
  if (device.factor == 0 || c >= image.format().channels) return {value, 0};
  switch (image.format().type) {
    case ChannelType::unorm8:
    case ChannelType::unorm16: return {value, kUnormDecodeError * value};
    case ChannelType::srgb8:
      if (c == 3) return {value, kUnormDecodeError * value};
      if (!device.srgb_polynomial) return {value, kUnitRoundoff * value};
      return {value, std::abs(srgb_polynomial_decode(byte_of(image, i, j, c)) - value) + kSrgbPolynomialError};
    default: return {value, 0};
  }
}

int wrap_index(std::int64_t i, int n, Wrap wrap) {
  switch (wrap) {
    case Wrap::clamp: return static_cast<int>(std::clamp<std::int64_t>(i, 0, n - 1));
    case Wrap::repeat: return static_cast<int>(((i % n) + n) % n);
    case Wrap::mirrored_repeat: {
      const std::int64_t period = 2 * static_cast<std::int64_t>(n);
      const std::int64_t m = ((i % period) + period) % period;
      return static_cast<int>(m < n ? m : period - 1 - m);
    }
  }
  return 0;
}

LookupPlan plan_lookup(const Image& image, const Sampler& sampler, const Coordinate& at, const DeviceModel& device) {
  LookupPlan plan;
  plan.image = &image;
  plan.sampler = sampler;
  plan.x = at.u * image.width();
  plan.y = at.v * image.height();
  const bool linear = sampler.filter == Filter::linear;
  const bool fraction_u = sampler.wrap_u == Wrap::repeat && !is_power_of_two(image.width());
  const bool fraction_v = sampler.wrap_v == Wrap::repeat && !is_power_of_two(image.height());
  plan.bound_x = texel_margin_bound(at.u, at.error_u, image.width(), fraction_u, linear, device);
  plan.bound_y = texel_margin_bound(at.v, at.error_v, image.height(), fraction_v, linear, device);
  plan.useless = !(plan.bound_x <= 0.5) || !(plan.bound_y <= 0.5);
  plan.fixed_point = linear && device.fixed_point_linear8 && image.format().type == ChannelType::unorm8 &&
                     sampler.wrap_u != Wrap::mirrored_repeat && sampler.wrap_v != Wrap::mirrored_repeat;
  return plan;
}

Choice nearest_choice(const LookupPlan& plan, std::int64_t i, std::int64_t j, const DeviceModel& device) {
  const Image& image = *plan.image;
  const int wi = wrap_index(i, image.width(), plan.sampler.wrap_u), wj = wrap_index(j, image.height(), plan.sampler.wrap_v);
  Choice choice;
  for (int c = 0; c < 4; ++c) choice.value[static_cast<std::size_t>(c)] = device_texel(image, wi, wj, c, device);
  // The border that lies between the exact coordinate and the texel chosen, on each axis.
  const auto crossed = [](double x, std::int64_t k) {
    const double low = static_cast<double>(k);
    return x < low ? low - x : std::max(0.0, x - (low + 1));
  };
  const bool own_x = static_cast<std::int64_t>(std::floor(plan.x)) == i, own_y = static_cast<std::int64_t>(std::floor(plan.y)) == j;
  choice.is_exact = own_x && own_y;
  const double mx = own_x ? 0 : crossed(plan.x, i), my = own_y ? 0 : crossed(plan.y, j);
  const bool by_x = !own_x && (own_y || mx * plan.bound_y >= my * plan.bound_x);
  choice.margin = by_x ? mx : my;
  choice.margin_bound = by_x ? plan.bound_x : plan.bound_y;
  return choice;
}

Choice linear_choice(const LookupPlan& plan, const DeviceModel& device) {
  const Image& image = *plan.image;
  const double x = plan.x - 0.5, y = plan.y - 0.5;
  const bool is_unorm8 = image.format().type == ChannelType::unorm8;
  const double extra =
      plan.fixed_point ? kFixedCoordinateError : (is_unorm8 ? device.weight_error_unorm8_texel : device.weight_error_texel);
  const double reach_x = plan.bound_x + extra, reach_y = plan.bound_y + extra;
  const auto i0 = static_cast<std::int64_t>(std::floor(x)), j0 = static_cast<std::int64_t>(std::floor(y));
  const double f = x - std::floor(x), g = y - std::floor(y);
  const std::int64_t a = plan.useless ? i0 : static_cast<std::int64_t>(std::floor(x - reach_x));
  const std::int64_t b = plan.useless ? i0 : static_cast<std::int64_t>(std::floor(x + reach_x));
  const std::int64_t c = plan.useless ? j0 : static_cast<std::int64_t>(std::floor(y - reach_y));
  const std::int64_t d = plan.useless ? j0 : static_cast<std::int64_t>(std::floor(y + reach_y));
  const bool is_float = image.format().type == ChannelType::float32 || image.format().type == ChannelType::half;
  const double floating = is_float ? 1 : 0;
  Choice choice;
  for (int channel = 0; channel < 4; ++channel) {
    const auto t = [&](std::int64_t i, std::int64_t j) {
      Bounded texel = device_texel(image, wrap_index(i, image.width(), plan.sampler.wrap_u),
                                   wrap_index(j, image.height(), plan.sampler.wrap_v), channel, device);
      if (is_float) texel.value = static_cast<double>(canonical(static_cast<float>(texel.value)));
      return texel;
    };
    // Filtered float texels enter the contract's filter canonical: the device keeps what is below 2^-40.
    const Bounded t00 = t(i0, j0), t10 = t(i0 + 1, j0), t01 = t(i0, j0 + 1), t11 = t(i0 + 1, j0 + 1);
    Bounded& value = choice.value[static_cast<std::size_t>(channel)];
    value.value = (1 - g) * ((1 - f) * t00.value + f * t10.value) + g * ((1 - f) * t01.value + f * t11.value);
    if (device.factor == 0) {
      value.bound = 0x1p-48 * std::max({std::abs(t00.value), std::abs(t10.value), std::abs(t01.value), std::abs(t11.value)});
      continue;
    }
    // The interpolant is piecewise bilinear: it moves by at most the steepest slope of the cells the coordinate may lie in.
    double slope_x = 0, slope_y = 0, largest = 0, decode = 0;
    for (std::int64_t j = c; j <= d + 1; ++j) {
      for (std::int64_t i = a; i <= b + 1; ++i) {
        const Bounded here = t(i, j);
        largest = std::max(largest, std::abs(here.value));
        decode = std::max(decode, here.bound);
        if (i <= b) slope_x = std::max(slope_x, std::abs(t(i + 1, j).value - here.value));
        if (j <= d) slope_y = std::max(slope_y, std::abs(t(i, j + 1).value - here.value));
      }
    }
    value.bound = slope_x * reach_x + slope_y * reach_y + decode + 0x1p-40 * floating +
                  (plan.fixed_point ? kFixedLerpError / 255 : kLinearFilterError * largest) +
                  (is_unorm8 ? device.filter_error_unorm8 : device.filter_error * largest);
  }
  return choice;
}

Choice fixed_point_choice(const LookupPlan& plan, std::int64_t s, std::int64_t t, bool truncating) {
  const Image& image = *plan.image;
  const std::int64_t i0 = s >> 8, j0 = t >> 8;
  const int wx = static_cast<int>(s & 255), wy = static_cast<int>(t & 255);
  const int left = wrap_index(i0, image.width(), plan.sampler.wrap_u), right = wrap_index(i0 + 1, image.width(), plan.sampler.wrap_u);
  const int low = wrap_index(j0, image.height(), plan.sampler.wrap_v), high = wrap_index(j0 + 1, image.height(), plan.sampler.wrap_v);
  Choice choice;
  for (int c = 0; c < 4; ++c) {
    Bounded& value = choice.value[static_cast<std::size_t>(c)];
    if (c >= image.format().channels) {
      value.value = kAbsent[c];
      continue;
    }
    const int below = lerp8(wx, byte_of(image, left, low, c), byte_of(image, right, low, c), truncating);
    const int above = lerp8(wx, byte_of(image, left, high, c), byte_of(image, right, high, c), truncating);
    const int result = lerp8(wy, below, above, truncating);
    value.value = result / 255.0;
    value.bound = kUnormDecodeError * value.value;
  }
  return choice;
}

}  // namespace etalon::validation
