#include "validation/storage_rounding.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/math/half.h"
#include "core/math/srgb.h"

namespace etalon::validation {

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

template <class T>
T load(const std::byte* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

Preimage unorm_preimage(unsigned code, unsigned maximum) {
  return {code == 0 ? -kInf : (code - 0.5) / maximum, code == maximum ? kInf : (code + 0.5) / maximum};
}

Preimage srgb_preimage(unsigned code) {
  // kSrgbThreshold[k − 1] is the smallest number stored as k.
  return {code == 0 ? -kInf : static_cast<double>(kSrgbThreshold[code - 1]),
          code == 255 ? kInf : static_cast<double>(kSrgbThreshold[code])};
}

Preimage half_preimage(std::uint16_t h, HalfRounding rounding) {
  const double value = half_to_double(h);
  if (std::isnan(value)) return {kInf, -kInf};
  const bool negative = (h & 0x8000) != 0;
  const unsigned magnitude = h & 0x7FFFu;
  double lo = 0, hi = 0;
  if (magnitude == 0x7C00u) {
    // Nothing finite is truncated to inf.
    lo = rounding == HalfRounding::toward_zero ? kInf : 65520;
    hi = rounding == HalfRounding::toward_zero ? -kInf : kInf;
    return negative ? Preimage{-hi, -lo} : Preimage{lo, hi};
  }
  const double above = magnitude == 0x7BFFu ? 65536.0 : half_to_double(static_cast<std::uint16_t>(magnitude + 1));
  const double middle_above = (std::abs(value) + above) / 2;
  if (magnitude == 0) {
    const double edge = rounding == HalfRounding::toward_zero ? above : middle_above;
    return {-edge, edge};
  }
  const double below = half_to_double(static_cast<std::uint16_t>(magnitude - 1));
  if (rounding == HalfRounding::toward_zero) {
    lo = std::abs(value);
    hi = magnitude == 0x7BFFu ? kInf : above;
  } else {
    lo = (std::abs(value) + below) / 2;
    hi = middle_above;
  }
  return negative ? Preimage{-hi, -lo} : Preimage{lo, hi};
}

int stored_maximum(ChannelType type) { return type == ChannelType::unorm16 ? 65535 : 255; }

}  // namespace

Preimage stored_preimage(const std::byte* stored, PixelFormat format, int channel, HalfRounding half_rounding) {
  const std::byte* at = stored + channel * bytes_per_channel(format.type);
  switch (format.type) {
    case ChannelType::unorm8: return unorm_preimage(load<std::uint8_t>(at), 255);
    case ChannelType::srgb8: return channel == 3 ? unorm_preimage(load<std::uint8_t>(at), 255) : srgb_preimage(load<std::uint8_t>(at));
    case ChannelType::unorm16: return unorm_preimage(load<std::uint16_t>(at), 65535);
    case ChannelType::half: return half_preimage(load<std::uint16_t>(at), half_rounding);
    case ChannelType::float32: {
      const double value = static_cast<double>(load<float>(at));
      return std::isnan(value) ? Preimage{kInf, -kInf} : Preimage{value, value};
    }
    case ChannelType::uint32: {
      const double value = load<std::uint32_t>(at);
      return {value, value};
    }
  }
  return {kInf, -kInf};
}

StoredCheck check_stored(const std::byte* stored, PixelFormat format, int channel, HalfRounding half_rounding, Bounded exact,
                         const DeviceModel& device) {
  Preimage p = stored_preimage(stored, format, channel, half_rounding);
  if (!(p.lo <= p.hi)) return {};
  if (device.unorm_toward_zero && (format.type == ChannelType::unorm8 || format.type == ChannelType::unorm16)) {
    const double half_step = 0.5 / stored_maximum(format.type);
    p = {p.lo + half_step, p.hi + half_step};
    if (p.hi > 1) p.hi = kInf;
  }
  const double distance = std::max({0.0, p.lo - exact.value, exact.value - p.hi});
  // 2^-50 covers the double in which the exact number and the interval's ends are held.
  double bound = exact.bound + 0x1p-50 * std::abs(exact.value);
  if (device.factor != 0) {
    const bool linear_unorm =
        format.type == ChannelType::unorm8 || format.type == ChannelType::unorm16 || (format.type == ChannelType::srgb8 && channel == 3);
    if (linear_unorm) {
      bound += kUnitRoundoff * std::min(1.0, std::abs(exact.value) + exact.bound) +
               (0x1p-50 + device.unorm_error_steps) / stored_maximum(format.type);
    } else if (format.type == ChannelType::srgb8 && device.srgb_polynomial) {
      // The thresholds are one unit apart in the encoded value, and further apart (in the linear one) the brighter.
      const unsigned code = load<std::uint8_t>(stored + channel);
      const unsigned at = code < 254 ? code + 1 : 254;
      bound += kSrgbEncodeError * (static_cast<double>(kSrgbThreshold[at]) - static_cast<double>(kSrgbThreshold[at - 1]));
    } else if (format.type == ChannelType::half) {
      bound += 0x1p-126;  // subnormal results of arithmetic are flushed
    } else if (format.type == ChannelType::float32) {
      bound += 0x1p-126;
    }
  }
  if (distance == 0) return {true, 0};
  return {distance <= bound, bound > 0 ? distance / bound : kInf};
}

StoredCheck check_texel(const std::byte* stored, PixelFormat format, HalfRounding half_rounding, const std::array<Bounded, 4>& exact,
                        const DeviceModel& device) {
  StoredCheck all{true, 0};
  for (int c = 0; c < format.channels; ++c) {
    const StoredCheck one = check_stored(stored, format, c, half_rounding, exact[static_cast<std::size_t>(c)], device);
    all.legal = all.legal && one.legal;
    all.share = std::max(all.share, one.share);
  }
  return all;
}

}  // namespace etalon::validation
