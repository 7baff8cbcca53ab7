// TIFF 6.0 section 2 and BigTIFF: where everything that the first image needs must lie.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/image/image.h"
#include "core/io/image_structure.h"
#include "core/io/input_error.h"

namespace etalon::io {
namespace {

enum : std::uint64_t {
  kImageWidth = 256,
  kImageLength = 257,
  kBitsPerSample = 258,
  kCompression = 259,
  kPhotometric = 262,
  kStripOffsets = 273,
  kSamplesPerPixel = 277,
  kRowsPerStrip = 278,
  kStripByteCounts = 279,
  kPlanarConfiguration = 284,
  kTileWidth = 322,
  kTileLength = 323,
  kTileOffsets = 324,
  kTileByteCounts = 325
};

/// Bytes of one value of each field type; 0 for types that do not exist.
constexpr std::array<std::uint64_t, 19> kTypeBytes = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};

class TiffWalk {
 public:
  TiffWalk(std::span<const std::byte> bytes, const std::string& name)
      : bytes_(bytes), name_(name), big_endian_(bytes[0] == std::byte{'M'}), is_big_tiff_(number(2, 2) == 43) {}

  void check() {
    if (is_big_tiff_ && number(4, 2) != 8) fail_at_byte(name_, 4, fmt::format("BigTIFF offset size: expected 8, got {}", number(4, 2)));
    const std::uint64_t directory = is_big_tiff_ ? number(8, 8) : number(4, 4);
    const std::uint64_t entry_count = number(directory, is_big_tiff_ ? 8 : 2);
    const std::uint64_t entry_bytes = is_big_tiff_ ? 20 : 12;
    const std::uint64_t entries = directory + (is_big_tiff_ ? 8 : 2);
    if (entry_count > bytes_.size() / entry_bytes)
      fail_at_byte(name_, directory, fmt::format("the file ends early: directory of {} entries", entry_count));
    for (std::uint64_t i = 0; i < entry_count; ++i) check_entry(entries + i * entry_bytes);
    number(entries + entry_count * entry_bytes, is_big_tiff_ ? 8 : 4);  // the next directory's offset
    check_blocks(strip_offsets_, strip_bytes_);
    check_blocks(tile_offsets_, tile_bytes_);
    check_size();
    if (tile_offsets_.empty()) check_strips();
  }

 private:
  struct Value {
    std::uint64_t number;
    std::uint64_t at;  // where it stands in the file
  };

  std::uint64_t number(std::uint64_t at, std::uint64_t size) const {
    if (at > bytes_.size() || bytes_.size() - at < size) fail_at_byte(name_, static_cast<std::size_t>(at), "the file ends early");
    std::uint64_t value = 0;
    for (std::uint64_t i = 0; i < size; ++i)
      value = value << 8 | static_cast<std::uint64_t>(bytes_[static_cast<std::size_t>(at + (big_endian_ ? i : size - 1 - i))]);
    return value;
  }

  void check_entry(std::uint64_t at) {
    const std::uint64_t tag = number(at, 2);
    const std::uint64_t type = number(at + 2, 2);
    const std::uint64_t field_bytes = is_big_tiff_ ? 8 : 4;
    const std::uint64_t count = number(at + 4, field_bytes);
    std::uint64_t values_at = at + 4 + field_bytes;
    const std::uint64_t size = type < kTypeBytes.size() ? kTypeBytes[type] : 0;
    if (size == 0) return;  // readers skip fields of unknown type (TIFF 6.0, section 7)
    if (count > bytes_.size() / size)
      fail_at_byte(name_, static_cast<std::size_t>(at), fmt::format("the file ends early: tag {} of {} values", tag, count));
    if (count * size > field_bytes) values_at = number(values_at, field_bytes);
    if (values_at > bytes_.size() || bytes_.size() - values_at < count * size)
      fail_at_byte(name_, static_cast<std::size_t>(at), fmt::format("the file ends early: tag {} points at byte {}", tag, values_at));
    const std::uint64_t value = count == 0 ? 0 : number(values_at, size);
    switch (tag) {
      case kImageWidth: check_side("image width", width_ = value, at); break;
      case kImageLength: check_side("image height", height_ = value, at); break;
      case kTileWidth: check_side("tile width", tile_width_ = value, at); break;
      case kTileLength: check_side("tile height", tile_height_ = value, at); break;
      case kBitsPerSample: bits_per_sample_ = value; break;
      case kSamplesPerPixel: samples_per_pixel_ = value; break;
      case kCompression: compression_ = value; break;
      case kPhotometric: photometric_ = value; break;
      case kRowsPerStrip: rows_per_strip_ = value; break;
      case kPlanarConfiguration: is_planar_ = value == 2; break;
      default: break;
    }
    std::vector<Value>* const list = tag == kStripOffsets      ? &strip_offsets_
                                     : tag == kStripByteCounts ? &strip_bytes_
                                     : tag == kTileOffsets     ? &tile_offsets_
                                     : tag == kTileByteCounts  ? &tile_bytes_
                                                               : nullptr;
    if (list == nullptr) return;
    list->clear();
    for (std::uint64_t i = 0; i < count; ++i) list->push_back({number(values_at + i * size, size), values_at + i * size});
  }

  void check_side(const char* what, std::uint64_t side, std::uint64_t at) const {
    if (side < 1 || side > static_cast<std::uint64_t>(kMaxImageSize))
      fail_at_byte(name_, static_cast<std::size_t>(at), fmt::format("{}: expected 1 to {}, got {}", what, kMaxImageSize, side));
  }

  /// The most bytes that one byte of the file can become.
  [[nodiscard]] std::uint64_t best_ratio() const {
    switch (compression_) {
      case 1: return 4;         // none; YCbCr of 4 × 4 samples to one of each colour holds 18 of 48
      case 5: return 2560;      // LZW: 3,838 bytes (TIFF 6.0, section 13: strings of at most 4,096 - 258) by a code of 12 bits
      case 8:                   // deflate: 258 bytes by two bits
      case 32946: return 1032;  // its older number
      case 32773: return 64;    // PackBits: 128 by two
      default: return 32768;    // zstd: blocks of 128 KiB by four bytes; CCITT: a row of at most 32,768 by one bit
    }
  }

  /// A small file cannot hold a large image, nor a large tile: both are refused before memory is taken for them.
  void check_size() const {
    const std::uint64_t texel_bits = std::min<std::uint64_t>(bits_per_sample_, 64) * std::min<std::uint64_t>(samples_per_pixel_, 65535);
    for (const auto& [what, texels] : {std::pair("image", width_ * height_), std::pair("tile", tile_width_ * tile_height_)}) {
      const std::uint64_t least = texels * texel_bits / 8 / best_ratio();
      if (least > bytes_.size())
        fail_file(name_, fmt::format("expected at least {} bytes for the size of its {}, got {}", least, what, bytes_.size()));
    }
  }

  /// Decoders leave the texels of a strip that is missing or short as they are.
  void check_strips() const {
    const std::uint64_t rows = std::clamp<std::uint64_t>(rows_per_strip_, 1, std::max<std::uint64_t>(height_, 1));
    const std::uint64_t strips = (height_ + rows - 1) / rows, planes = is_planar_ ? std::min<std::uint64_t>(samples_per_pixel_, 65535) : 1;
    if (strip_offsets_.size() < strips * planes)
      fail_file(name_, fmt::format("strips: expected {}, got {}", strips * planes, strip_offsets_.size()));
    constexpr std::uint64_t kNone = 1, kYCbCr = 6;
    if (compression_ != kNone || photometric_ == kYCbCr) return;
    const std::uint64_t texel_bits =
        std::min<std::uint64_t>(bits_per_sample_, 64) * (is_planar_ ? 1 : std::min<std::uint64_t>(samples_per_pixel_, 65535));
    for (std::size_t i = 0; i < std::min<std::size_t>(strip_bytes_.size(), strips * planes); ++i) {
      const std::uint64_t least = std::min(rows, height_ - i % strips * rows) * ((width_ * texel_bits + 7) / 8);
      if (strip_bytes_[i].number < least)
        fail_at_byte(name_, static_cast<std::size_t>(strip_bytes_[i].at),
                     fmt::format("strip {}: expected {} bytes, got {}", i, least, strip_bytes_[i].number));
    }
  }

  void check_blocks(const std::vector<Value>& offsets, const std::vector<Value>& sizes) const {
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      // Where byte counts are missing the decoder estimates them; the beginning must be there all the same.
      const std::uint64_t size = i < sizes.size() ? sizes[i].number : 0;
      const std::uint64_t offset = offsets[i].number;
      if (offset > bytes_.size() || bytes_.size() - offset < size)
        fail_at_byte(
            name_, static_cast<std::size_t>(offsets[i].at),
            fmt::format("the file ends early: block {} expected at bytes {} to {}, got {} bytes", i, offset, offset + size, bytes_.size()));
    }
  }

  std::span<const std::byte> bytes_;
  const std::string& name_;
  bool big_endian_;
  bool is_big_tiff_;
  std::uint64_t width_ = 0, height_ = 0, tile_width_ = 0, tile_height_ = 0;
  // With the defaults of TIFF 6.0, section 8.
  std::uint64_t bits_per_sample_ = 1, samples_per_pixel_ = 1, compression_ = 1, photometric_ = 0, rows_per_strip_ = ~std::uint64_t{0};
  bool is_planar_ = false;
  std::vector<Value> strip_offsets_, strip_bytes_, tile_offsets_, tile_bytes_;
};

}  // namespace

void check_tiff_structure(std::span<const std::byte> bytes, const std::string& name) { TiffWalk(bytes, name).check(); }

}  // namespace etalon::io
