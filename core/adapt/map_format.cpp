#include "core/adapt/map_format.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/math/half.h"

namespace etalon::adapt {
namespace {

// round((2k + 1)·most / 2n), half to even.
std::uint32_t unorm_center(int k, int n, std::uint32_t most) {
  const std::uint64_t numerator = (2 * static_cast<std::uint64_t>(k) + 1) * most, denominator = 2 * static_cast<std::uint64_t>(n);
  const std::uint64_t quotient = numerator / denominator, twice_rest = 2 * (numerator % denominator);
  const bool up = twice_rest > denominator || (twice_rest == denominator && quotient % 2 != 0);
  return static_cast<std::uint32_t>(quotient + (up ? 1 : 0));
}

// (k + ½)/n is a quotient of integers below 2^17. It differs from the middle of two halves or floats next to each other, a multiple of
// 2^-25 of its own magnitude, by nothing or by more than 2^-25·2^-17 of it: rounding to double first changes no decision.
double center(int k, int n) { return (k + 0.5) / n; }

// The texel that nearest lookup of what is stored finds, floor(stored · n), clamped: exact, the product of 24 and 16 bits.
int found(int k, int n, ChannelType type) {
  const auto size = static_cast<std::uint64_t>(n);
  double at = 0;
  switch (type) {
    case ChannelType::float32: at = static_cast<double>(static_cast<float>(center(k, n))) * n; break;
    case ChannelType::half: at = half_to_double(half_nearest_even(center(k, n))) * n; break;
    case ChannelType::unorm16: at = static_cast<double>(unorm_center(k, n, 65535) * size / 65535); break;
    default: at = static_cast<double>(unorm_center(k, n, 255) * size / 255); break;
  }
  return std::min(static_cast<int>(at), n - 1);
}

void require_map_type(ChannelType type) {
  if (type != ChannelType::float32 && type != ChannelType::half && type != ChannelType::unorm16 && type != ChannelType::unorm8)
    throw InputError(fmt::format("indexing map: expected float32, half, unorm16 or unorm8, got {}", to_string(type)));
}

void store(Image& map, int x, int y, int channel, int k, int n) {
  switch (map.format().type) {
    case ChannelType::float32: map.channels<float>(x, y)[channel] = static_cast<float>(center(k, n)); break;
    case ChannelType::half: map.channels<std::uint16_t>(x, y)[channel] = half_nearest_even(center(k, n)); break;
    case ChannelType::unorm16: map.channels<std::uint16_t>(x, y)[channel] = static_cast<std::uint16_t>(unorm_center(k, n, 65535)); break;
    default: map.channels<std::uint8_t>(x, y)[channel] = static_cast<std::uint8_t>(unorm_center(k, n, 255)); break;
  }
}

std::size_t unnamed_along(int n, ChannelType type) {
  std::size_t count = 0;
  for (int k = 0; k < n; ++k) count += found(k, n, type) != k ? 1 : 0;
  return count;
}

}  // namespace

Image identity_map(int width, int height, ChannelType type) {
  require_map_type(type);
  Image map(width, height, {type, 2});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) store(map, x, y, 0, x, width), store(map, x, y, 1, y, height);
  return map;
}

Vec2d map_coordinate(const Image& map, int x, int y) {
  switch (map.format().type) {
    case ChannelType::float32: {
      const auto* const c = map.channels<float>(x, y);
      return {c[0], c[1]};
    }
    case ChannelType::half: {
      const auto* const c = map.channels<std::uint16_t>(x, y);
      return {half_to_double(c[0]), half_to_double(c[1])};
    }
    case ChannelType::unorm16: {
      const auto* const c = map.channels<std::uint16_t>(x, y);
      return {c[0] / 65535.0, c[1] / 65535.0};
    }
    default: {
      const auto* const c = map.channels<std::uint8_t>(x, y);
      return {c[0] / 255.0, c[1] / 255.0};
    }
  }
}

void set_map_coordinate(Image& map, int x, int y, const Vec2d& p) {
  const auto unorm = [](double value, double most) { return std::clamp(value, 0.0, 1.0) * most + 0.5; };
  switch (map.format().type) {
    case ChannelType::float32: {
      auto* const c = map.channels<float>(x, y);
      c[0] = static_cast<float>(p.x), c[1] = static_cast<float>(p.y);
      break;
    }
    case ChannelType::half: {
      auto* const c = map.channels<std::uint16_t>(x, y);
      c[0] = half_nearest_even(p.x), c[1] = half_nearest_even(p.y);
      break;
    }
    case ChannelType::unorm16: {
      auto* const c = map.channels<std::uint16_t>(x, y);
      c[0] = static_cast<std::uint16_t>(unorm(p.x, 65535)), c[1] = static_cast<std::uint16_t>(unorm(p.y, 65535));
      break;
    }
    default: {
      auto* const c = map.channels<std::uint8_t>(x, y);
      c[0] = static_cast<std::uint8_t>(unorm(p.x, 255)), c[1] = static_cast<std::uint8_t>(unorm(p.y, 255));
      break;
    }
  }
}

std::size_t unnamed_texels(int width, int height, ChannelType type) {
  require_map_type(type);
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  return columns * rows - (columns - unnamed_along(width, type)) * (rows - unnamed_along(height, type));
}

}  // namespace etalon::adapt
