#include "core/io/image_structure.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "core/image/image.h"
#include "core/io/input_error.h"

namespace etalon::io {
namespace {

class Walk {
 public:
  Walk(std::span<const std::byte> bytes, const std::string& name) : bytes_(bytes), name_(name) {}
  [[nodiscard]] std::size_t at() const { return at_; }
  void go_back_to(std::size_t offset) { at_ = offset; }
  [[noreturn]] void fail(const std::string& what) const { fail_at_byte(name_, at_, what); }
  std::span<const std::byte> take(std::size_t count, const char* what) {
    if (bytes_.size() - at_ < count)
      fail(fmt::format("the file ends early: {}: expected {} bytes, got {}", what, count, bytes_.size() - at_));
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }
  std::uint8_t take_u8(const char* what) { return static_cast<std::uint8_t>(take(1, what)[0]); }
  /// Big-endian.
  std::uint32_t take_be(int byte_count, const char* what) {
    std::uint32_t value = 0;
    for (const std::byte b : take(static_cast<std::size_t>(byte_count), what)) value = value << 8 | static_cast<std::uint8_t>(b);
    return value;
  }
  std::uint32_t take_le32(const char* what) { return __builtin_bswap32(take_be(4, what)); }
  /// Characters up to a zero byte, which is taken too.
  std::string_view take_string(const char* what) {
    const std::size_t begin = at_;
    while (take_u8(what) != 0) {
    }
    return {reinterpret_cast<const char*>(bytes_.data()) + begin, at_ - begin - 1};
  }

 private:
  std::span<const std::byte> bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
};

/// CRC-32 of PNG (PNG specification, annex D).
std::uint32_t crc32(std::span<const std::byte> bytes) {
  static const std::array<std::uint32_t, 256> kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t c = i;
      for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
      table[i] = c;
    }
    return table;
  }();
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const std::byte b : bytes) crc = kTable[(crc ^ static_cast<std::uint8_t>(b)) & 0xFF] ^ (crc >> 8);
  return ~crc;
}

constexpr int kMaxJpegScans = 500;

/// SOF0 to SOF15, which hold the size; not the tables DHT, JPG and DAC among them.
bool is_frame_header(std::uint8_t marker) { return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC; }

/// Of one component at least, each block of 8 × 8 has a code of at least one bit; arithmetic coding (from SOF9) may need a sixty-fourth of it.
void check_jpeg_size(std::span<const std::byte> frame_header, std::uint8_t marker, std::size_t file_bytes, const std::string& name) {
  if (frame_header.size() < 5) fail_file(name, "frame header: expected at least 5 bytes");
  const auto be16 = [&](std::size_t i) {
    return std::to_integer<std::size_t>(frame_header[i]) << 8 | std::to_integer<std::size_t>(frame_header[i + 1]);
  };
  const std::size_t least = ((be16(1) + 7) / 8) * ((be16(3) + 7) / 8) / (marker < 0xC9 ? 8 : 512);
  if (least > file_bytes)
    fail_file(name, fmt::format("expected at least {} bytes for its size of {}x{}, got {}", least, be16(3), be16(1), file_bytes));
}

}  // namespace

void check_png_structure(std::span<const std::byte> bytes, const std::string& name) {
  Walk walk(bytes, name);
  walk.take(8, "signature");
  std::size_t raw_bytes = 0;
  while (true) {
    const std::uint32_t length = walk.take_be(4, "chunk length");
    const std::size_t type_at = walk.at();
    const std::span<const std::byte> type_bytes = walk.take(4, "chunk type");
    const std::string type(reinterpret_cast<const char*>(type_bytes.data()), 4);
    const std::span<const std::byte> data = walk.take(length, "chunk data");
    const std::uint32_t expected_crc = crc32(bytes.subspan(type_at, std::size_t{4} + length));
    const std::uint32_t crc = walk.take_be(4, "chunk checksum");
    if (crc != expected_crc) walk.fail(fmt::format("chunk {}: checksum: expected {:08x}, got {:08x}", printable(type), expected_crc, crc));
    if (type == "IHDR" && data.size() == 13) {
      const auto be32 = [&](std::size_t i) {
        std::uint32_t v = 0;
        for (std::size_t k = i; k < i + 4; ++k) v = v << 8 | static_cast<std::uint8_t>(data[k]);
        return v;
      };
      const std::uint32_t width = be32(0), height = be32(4);
      if (width == 0 || height == 0 || width > kMaxImageSize || height > kMaxImageSize)
        walk.fail(fmt::format("image size: expected 1x1 to {0}x{0}, got {1}x{2}", kMaxImageSize, width, height));
      // A row holds at least one bit per texel.
      raw_bytes = static_cast<std::size_t>(height) * ((width + 7) / 8);
    }
    if (type == "IEND") break;
  }
  // Deflate makes at most 1032 bytes of one (258 bytes from two bits), so a small file cannot hold a large image.
  if (raw_bytes / 1032 > bytes.size())
    fail_file(name, fmt::format("expected at least {} bytes for its size, got {}", raw_bytes / 1032, bytes.size()));
}

void check_jpeg_structure(std::span<const std::byte> bytes, const std::string& name) {
  Walk walk(bytes, name);
  walk.take(2, "start of image");
  int scan_count = 0;
  while (true) {
    if (walk.take_u8("marker") != 0xFF) walk.fail("expected a marker (0xFF), got data");
    std::uint8_t marker = walk.take_u8("marker");
    while (marker == 0xFF) marker = walk.take_u8("marker");
    if (marker == 0xD9) return;
    // Stand-alone markers: TEM, RSTn.
    if (marker == 0x01 || (marker >= 0xD0 && marker <= 0xD7)) continue;
    const std::uint32_t length = walk.take_be(2, "segment length");
    if (length < 2) walk.fail(fmt::format("segment length: expected at least 2, got {}", length));
    const std::span<const std::byte> segment = walk.take(length - 2, "segment");
    if (is_frame_header(marker)) check_jpeg_size(segment, marker, bytes.size(), name);
    if (marker != 0xDA) continue;
    // Each scan may go through all of the image; ten is what progressive files have.
    if (++scan_count > kMaxJpegScans) walk.fail(fmt::format("expected at most {} scans", kMaxJpegScans));
    // Entropy-coded data of the scan: up to the next 0xFF that is neither stuffed (FF 00) nor a restart marker.
    while (true) {
      if (walk.take_u8("scan data") != 0xFF) continue;
      const std::size_t before = walk.at();
      std::uint8_t next = walk.take_u8("scan data");
      while (next == 0xFF) next = walk.take_u8("scan data");
      if (next == 0 || (next >= 0xD0 && next <= 0xD7)) continue;
      walk.go_back_to(before - 1);  // a marker: the outer loop's business
      break;
    }
  }
}

void check_exr_structure(std::span<const std::byte> bytes, const std::string& name) {
  Walk walk(bytes, name);
  walk.take(4, "magic number");
  const std::uint32_t version = walk.take_le32("version");
  if ((version & 0xFF) != 2) walk.fail(fmt::format("OpenEXR version: expected 2, got {}", version & 0xFF));
  if ((version & 0x1800) != 0) walk.fail("expected a single-part flat image, got a deep or multi-part one");
  bool has_data_window = false;
  while (true) {
    const std::string_view attribute = walk.take_string("header");
    if (attribute.empty()) break;
    const std::string_view type = walk.take_string("header");
    const std::uint32_t size = walk.take_le32("header");
    if (attribute == "dataWindow" && type == "box2i" && size == 16) {
      std::array<std::int64_t, 4> box;
      for (auto& v : box) v = static_cast<std::int32_t>(walk.take_le32("data window"));
      const std::int64_t width = box[2] - box[0] + 1, height = box[3] - box[1] + 1;
      if (width < 1 || height < 1 || width > kMaxImageSize || height > kMaxImageSize)
        walk.fail(fmt::format("image size: expected 1x1 to {0}x{0}, got {1}x{2}", kMaxImageSize, width, height));
      has_data_window = true;
    } else {
      walk.take(size, "header attribute");
    }
  }
  if (!has_data_window) walk.fail("expected a data window in the header, got none");
}

}  // namespace etalon::io
