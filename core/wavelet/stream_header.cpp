#include "core/wavelet/stream_header.h"

#include <array>
#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/wavelet/checksum.h"
#include "core/wavelet/color.h"

namespace etalon::wavelet {
namespace {

constexpr std::string_view kMagic = "eTWS";
constexpr std::uint8_t kVersion = 1;
constexpr std::size_t kFixedBytes = 13, kDelayBytes = 4, kCheckBytes = 2;
constexpr int kExponentOffset = 64;
enum Flags : std::uint8_t { kIs97 = 1, kHasDelays = 2, kIsColour = 4, kIsSrgb = 8, kAllFlags = 15 };

std::uint32_t check_of(std::span<const std::byte> bytes) { return crc32(bytes) & 0xFFFF; }

std::uint32_t number(std::span<const std::byte> bytes, std::size_t at, std::size_t count) {
  std::uint32_t x = 0;
  for (std::size_t i = 0; i < count; ++i) x |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
  return x;
}

void require_bytes(std::span<const std::byte> stream, std::size_t count) {
  if (stream.size() < count)
    throw InputError(fmt::format("texture stream: expected a header of at least {} bytes, got {}", count, stream.size()));
}

}  // namespace

std::vector<std::byte> header_bytes(const TextureHeader& header) {
  std::vector<std::byte> bytes;
  const auto put = [&](std::uint32_t x, int count) {
    for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::byte>((x >> (8 * i)) & 0xFF));
  };
  for (const char c : kMagic) put(static_cast<std::uint8_t>(c), 1);
  put(kVersion, 1);
  std::uint32_t flags = header.kernel == Kernel::irreversible_9_7 ? kIs97 : 0;
  if (header.has_delays) flags |= kHasDelays;
  if (header.format.channels == 3) flags |= kIsColour;
  if (header.format.type == ChannelType::srgb8) flags |= kIsSrgb;
  put(flags, 1);
  put(static_cast<std::uint32_t>(header.levels), 1);
  put(static_cast<std::uint32_t>(header.width - 1), 2);
  put(static_cast<std::uint32_t>(header.height - 1), 2);
  put(static_cast<std::uint32_t>(header.step_exponent + kExponentOffset), 1);
  put(static_cast<std::uint32_t>(header.top_exponent + kExponentOffset), 1);
  if (header.has_delays) put(header.delays_checksum, 4);
  put(check_of(bytes), 2);
  return bytes;
}

TextureHeader read_texture_header(std::span<const std::byte> stream, const DecodeLimits& limits) {
  require_bytes(stream, kFixedBytes + kCheckBytes);
  for (std::size_t i = 0; i < kMagic.size(); ++i)
    if (std::to_integer<char>(stream[i]) != kMagic[i]) throw InputError("texture stream: byte 0: expected the signature eTWS");
  if (number(stream, 4, 1) != kVersion)
    throw InputError(fmt::format("texture stream: byte 4: expected version {}, got {}", kVersion, number(stream, 4, 1)));
  const std::uint32_t flags = number(stream, 5, 1);
  TextureHeader header;
  header.kernel = (flags & kIs97) != 0 ? Kernel::irreversible_9_7 : Kernel::reversible_5_3;
  header.has_delays = (flags & kHasDelays) != 0;
  header.format = {(flags & kIsSrgb) != 0 ? ChannelType::srgb8 : ChannelType::unorm8, (flags & kIsColour) != 0 ? 3 : 1};
  header.levels = static_cast<int>(number(stream, 6, 1));
  header.width = static_cast<int>(number(stream, 7, 2)) + 1;
  header.height = static_cast<int>(number(stream, 9, 2)) + 1;
  header.step_exponent = static_cast<int>(number(stream, 11, 1)) - kExponentOffset;
  header.top_exponent = static_cast<int>(number(stream, 12, 1)) - kExponentOffset;
  const std::size_t end = kFixedBytes + (header.has_delays ? kDelayBytes : 0);
  header.bytes = end + kCheckBytes;
  require_bytes(stream, header.bytes);
  if (header.has_delays) header.delays_checksum = number(stream, kFixedBytes, 4);

  if (number(stream, end, 2) != check_of(stream.first(end)))
    throw InputError(fmt::format("texture stream: byte {}: the header's checksum is wrong", end));
  if (flags > kAllFlags) throw InputError(fmt::format("texture stream: byte 5: expected flags below {}, got {}", kAllFlags + 1, flags));
  if (header.levels < 1 || header.levels > kMaxLevels)
    throw InputError(fmt::format("texture stream: byte 6: expected 1 to {} levels, got {}", kMaxLevels, header.levels));
  if (header.width > kMaxImageSize || header.height > kMaxImageSize ||
      static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height) > limits.max_texels)
    throw InputError(fmt::format("texture stream: byte 7: expected at most {} texels (and {} a side), got {} x {}", limits.max_texels,
                                 kMaxImageSize, header.width, header.height));
  if (header.step_exponent < kMinStepExponent || header.step_exponent > kMaxStepExponent)
    throw InputError(fmt::format("texture stream: byte 11: expected a step exponent of {} to {}, got {}", kMinStepExponent,
                                 kMaxStepExponent, header.step_exponent));
  if (header.top_exponent > 40)
    throw InputError(fmt::format("texture stream: byte 12: expected a top exponent up to 40, got {}", header.top_exponent));
  return header;
}

void require_delays_fit(const Delays& delays, int width, int height, int levels) {
  if (delays.empty()) return;
  if (delays.width != width || delays.height != height || delays.levels != levels)
    throw InputError(fmt::format("texture stream: expected delays of {} x {} coefficients and {} levels, got {} x {} and {}", width, height,
                                 levels, delays.width, delays.height, delays.levels));
  ETALON_CHECK(delays.planes.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
               fmt::to_string(delays.planes.size()));
}

double quantisation_step(const TextureHeader& header, const Subband& band, int channel) {
  const int e = header.step_exponent;
  const double finest = e < 0 ? 1.0 / static_cast<double>(1 << -e) : static_cast<double>(1 << e);
  return finest / (band.norm * channel_norm(channel, header.format.channels, header.kernel));
}

std::vector<double> coded_gains(const TextureHeader& header, const std::vector<Subband>& bands) {
  std::vector<double> gains;
  for (int c = 0; c < header.format.channels; ++c)
    for (const Subband& band : bands)
      gains.push_back(header.kernel == Kernel::irreversible_9_7 ? 1.0 : band.norm * channel_norm(c, header.format.channels, header.kernel));
  return gains;
}

std::vector<BandState> fresh_states(const TextureHeader& header, const std::vector<Subband>& bands, const Delays& delays) {
  return make_band_states(bands, coded_gains(header, bands), header.format.channels, header.top_exponent, delays);
}

}  // namespace etalon::wavelet
