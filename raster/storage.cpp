#include "raster/storage.h"

#include <cstring>

#include "core/math/srgb.h"

namespace etalon::raster {
namespace {

template <class T>
void put(T value, std::byte* channel) {
  std::memcpy(channel, &value, sizeof value);
}

double clamp01(double x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

// floor(x·scale + ½) on both ends, widened by more than its roundings as in to_unorm(); equal floors decide, since the tie lies on the border.
bool try_unorm(Interval v, double scale, std::uint32_t& result) {
  const double lo = clamp01(v.lo) * scale + 0.5, hi = clamp01(v.hi) * scale + 0.5;
  const auto below = static_cast<std::uint32_t>(lo - 0x1p-34), above = static_cast<std::uint32_t>(hi + 0x1p-34);
  result = below;
  return below == above;
}

}  // namespace

bool ChannelStore::try_store(Interval v, std::byte* channel) const {
  switch (type) {
    case ChannelType::unorm8:
    case ChannelType::srgb8: {
      if (type == ChannelType::srgb8 && !alpha) {
        const auto reached = [](double x) {
          return std::upper_bound(std::begin(kSrgbThreshold), std::end(kSrgbThreshold), x) - std::begin(kSrgbThreshold);
        };
        const auto lo = reached(v.lo), hi = reached(v.hi);
        if (lo != hi) return false;
        put(static_cast<std::uint8_t>(lo), channel);
        return true;
      }
      std::uint32_t value = 0;
      if (!try_unorm(v, 255, value)) return false;
      put(static_cast<std::uint8_t>(value), channel);
      return true;
    }
    case ChannelType::unorm16: {
      std::uint32_t value = 0;
      if (!try_unorm(v, 65535, value)) return false;
      put(static_cast<std::uint16_t>(value), channel);
      return true;
    }
    case ChannelType::half: {
      const bool truncate = half_rounding == HalfRounding::toward_zero;
      const std::uint16_t lo = truncate ? half_toward_zero(v.lo) : half_nearest_even(v.lo);
      const std::uint16_t hi = truncate ? half_toward_zero(v.hi) : half_nearest_even(v.hi);
      if (lo != hi && ((lo | hi) & 0x7FFF) != 0) return false;
      put(static_cast<std::uint16_t>((lo & 0x7FFF) == 0 ? 0 : lo), channel);
      return true;
    }
    case ChannelType::float32: {
      const float lo = static_cast<float>(v.lo), hi = static_cast<float>(v.hi);
      if (lo != hi) return false;
      put(lo + 0.0f, channel);
      return true;
    }
    case ChannelType::uint32: break;
  }
  return false;
}

template <int kLimbs>
void ChannelStore::store_exact(const Quotient<kLimbs>& q, std::byte* channel) const {
  const Interval v = enclose(q);
  switch (type) {
    case ChannelType::unorm8: put(static_cast<std::uint8_t>(to_unorm(q, v, 255)), channel); break;
    case ChannelType::srgb8: put(alpha ? static_cast<std::uint8_t>(to_unorm(q, v, 255)) : to_srgb8(q, v), channel); break;
    case ChannelType::unorm16: put(static_cast<std::uint16_t>(to_unorm(q, v, 65535)), channel); break;
    case ChannelType::half: put(to_half(q, v, half_rounding == HalfRounding::toward_zero), channel); break;
    case ChannelType::float32: put(to_float32(q, v), channel); break;
    case ChannelType::uint32: break;
  }
}

template void ChannelStore::store_exact(const Quotient<4>&, std::byte*) const;
template void ChannelStore::store_exact(const Quotient<8>&, std::byte*) const;
template void ChannelStore::store_exact(const Quotient<16>&, std::byte*) const;

void ChannelStore::store(const TexelValue& value, std::byte* channel) const {
  store_exact(Quotient<4>{WideInt<4>(value.m), WideInt<4>(value.den), -value.e}, channel);
}

}  // namespace etalon::raster
