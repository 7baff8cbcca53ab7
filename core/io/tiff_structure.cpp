// TIFF 6.0 section 2 and BigTIFF: where everything that the first image needs must lie.
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <vector>

#include "core/image/image.h"
#include "core/io/image_structure.h"
#include "core/io/input_error.h"

namespace etalon::io {
namespace {

enum : std::uint64_t {
  kImageWidth = 256,
  kImageLength = 257,
  kStripOffsets = 273,
  kStripByteCounts = 279,
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
    if (tag == kImageWidth || tag == kImageLength) check_side(tag, count == 0 ? 0 : number(values_at, size), at);
    std::vector<Value>* const list = tag == kStripOffsets      ? &strip_offsets_
                                     : tag == kStripByteCounts ? &strip_bytes_
                                     : tag == kTileOffsets     ? &tile_offsets_
                                     : tag == kTileByteCounts  ? &tile_bytes_
                                                               : nullptr;
    if (list == nullptr) return;
    list->clear();
    for (std::uint64_t i = 0; i < count; ++i) list->push_back({number(values_at + i * size, size), values_at + i * size});
  }

  void check_side(std::uint64_t tag, std::uint64_t side, std::uint64_t at) const {
    if (side < 1 || side > static_cast<std::uint64_t>(kMaxImageSize))
      fail_at_byte(name_, static_cast<std::size_t>(at),
                   fmt::format("image {}: expected 1 to {}, got {}", tag == kImageWidth ? "width" : "height", kMaxImageSize, side));
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
  std::vector<Value> strip_offsets_, strip_bytes_, tile_offsets_, tile_bytes_;
};

}  // namespace

void check_tiff_structure(std::span<const std::byte> bytes, const std::string& name) { TiffWalk(bytes, name).check(); }

}  // namespace etalon::io
