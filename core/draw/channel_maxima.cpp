#include "core/draw/channel_maxima.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/parallel.h"
#include "core/math/half.h"

namespace etalon {
namespace {

constexpr std::size_t kBlock = 16384;

// Magnitudes of one float format are ordered as their bits without the sign, NaN last.
template <class Bits>
std::array<Bits, 4> largest_bits(const Image& image) {
  constexpr Bits magnitude = static_cast<Bits>(~Bits{0}) >> 1;
  const auto channels = static_cast<std::size_t>(image.format().channels);
  const auto* const numbers = reinterpret_cast<const Bits*>(image.bytes().data());
  std::vector<std::array<Bits, 4>> blocks((image.texel_count() + kBlock - 1) / kBlock);
  parallel_for_blocks(image.texel_count(), kBlock, [&](std::size_t begin, std::size_t end) {
    constexpr std::size_t period = 12;  // a multiple of 1, 2, 3 and 4 channels: number n belongs to channel n mod period mod channels
    std::array<Bits, period> most{};
    std::size_t n = begin * channels;
    for (; n + period <= end * channels; n += period)
      for (std::size_t k = 0; k < period; ++k) most[k] = std::max(most[k], static_cast<Bits>(numbers[n + k] & magnitude));
    for (std::size_t k = 0; n + k < end * channels; ++k) most[k] = std::max(most[k], static_cast<Bits>(numbers[n + k] & magnitude));
    std::array<Bits, 4>& block = blocks[begin / kBlock];
    for (std::size_t k = 0; k < period; ++k) block[k % channels] = std::max(block[k % channels], most[k]);
  });
  std::array<Bits, 4> largest{};
  for (const auto& block : blocks)
    for (std::size_t c = 0; c < 4; ++c) largest[c] = std::max(largest[c], block[c]);
  return largest;
}

}  // namespace

ChannelMaxima channel_maxima(const Image& image) {
  const auto finite_or_infinite = [](double magnitude) {
    return std::isnan(magnitude) ? std::numeric_limits<double>::infinity() : magnitude;
  };
  ChannelMaxima largest{1, 1, 1, 1};
  if (image.format().type == ChannelType::half) {
    const auto bits = largest_bits<std::uint16_t>(image);
    for (std::size_t c = 0; c < 4; ++c) largest[c] = finite_or_infinite(half_to_double(bits[c]));
  } else if (image.format().type == ChannelType::float32) {
    const auto bits = largest_bits<std::uint32_t>(image);
    for (std::size_t c = 0; c < 4; ++c) largest[c] = finite_or_infinite(std::bit_cast<float>(bits[c]));
  }
  return largest;
}

}  // namespace etalon
