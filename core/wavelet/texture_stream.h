// A texture as one embedded stream of bytes: every prefix from the header on is a picture, each byte more a better one, and all of them the same
// bytes on every machine. docs/formats.md#texture-stream.
//
// Does: 5/3 (reversible, the whole stream is lossless) and 9/7, 1 or 3 channels of 8 bits, any size; coefficients that a view does not need are
// left out or delayed; records which prefix holds a given share of the significant coefficients. Does not: alpha, tiles, regions, resolutions.
// The coding is serial; transforms use the threads of core/base/parallel.h, and nothing depends on their number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/image/image.h"
#include "core/wavelet/delays.h"
#include "core/wavelet/subbands.h"

namespace etalon::wavelet {

struct EncodeOptions {
  Kernel kernel = Kernel::reversible_5_3;
  int levels = 0;          ///< 1..kMaxLevels; 0: default_levels()
  int step_exponent = -1;  ///< 9/7: the finest quantisation is 2^this, in RGB error of a coefficient; -6..6
  Delays delays;           ///< of the image's size and these levels, or empty
  /// Ascending shares, in (0, 1], of the coefficients that are significant (not 0) in the whole stream; for each the stream's point is recorded.
  std::vector<double> significant_shares;
  /// Ascending delays; for each the stream's point is recorded at which all bits of the coefficients of no longer delay are known, which means whole
  /// levels of a pyramid. Not together with shares.
  std::vector<int> complete_delays;
  bool stops_at_last_share = false;  ///< the stream ends with the last point instead of being complete
  std::size_t max_bytes = 0;         ///< the stream ends here at the latest; 0: no limit. Points behind it are not recorded
};

/// The shortest prefix that tells at least `significant` coefficients from 0, with their signs; or that holds all of a delay's.
struct StreamPoint {
  std::size_t bytes = 0;
  std::size_t significant = 0;
};

struct EncodedTexture {
  std::vector<std::byte> bytes;
  std::vector<StreamPoint> points;    ///< one a share or delay, ascending; several of a tiny picture may be one point
  std::size_t significant_total = 0;  ///< coefficients that are not 0, over all channels, never-sent ones apart
  bool is_complete = false;           ///< nothing was cut: 5/3 without never-sent coefficients is lossless
};

/// Formats other than 1 or 3 channels of 8 bits, delays of another size, shares or delays that do not ascend, both of them: InputError.
[[nodiscard]] EncodedTexture encode_texture(const Image& image, const EncodeOptions& options = {});

struct TextureHeader {
  Kernel kernel = Kernel::reversible_5_3;
  int levels = 1, width = 1, height = 1;
  PixelFormat format = kRgb8;
  int step_exponent = 0, top_exponent = 0;
  bool has_delays = false;
  std::uint32_t delays_checksum = 0;
  std::size_t bytes = 0;  ///< of the header itself: the shortest prefix that is a picture
};

/// Decoding takes 45 to 70 bytes a texel of three channels, the least of them by the header alone: hence a limit, 4096².
struct DecodeLimits {
  std::size_t max_texels = std::size_t{1} << 24;
};

/// InputError, which names the byte, for anything that is no header of a texture stream or a picture beyond the limits.
[[nodiscard]] TextureHeader read_texture_header(std::span<const std::byte> stream, const DecodeLimits& limits = {});

struct DecodedTexture {
  Image image;
  std::size_t significant = 0;  ///< coefficients known not to be 0
  bool is_complete = false;     ///< the stream's last bit was reached
};

/// The picture of a prefix. InputError: no header, or delays that are not those it was made with. Bytes behind a complete stream are ignored.
[[nodiscard]] DecodedTexture decode_texture(std::span<const std::byte> prefix, const Delays& delays = {}, const DecodeLimits& limits = {});

/// The pictures of several prefixes of one stream, in one go: on_prefix(i, picture) for i = 0, 1, …, each equal to decode_texture() of its prefix.
/// `prefix_bytes` ascend and lie between the header's bytes and the stream's (InputError).
void decode_prefixes(std::span<const std::byte> stream, std::span<const std::size_t> prefix_bytes, const Delays& delays,
                     const std::function<void(std::size_t, DecodedTexture)>& on_prefix, const DecodeLimits& limits = {});

}  // namespace etalon::wavelet
