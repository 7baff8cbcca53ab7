// Images that claim more than their files can hold are refused before memory or time is spent on the claim.
#include <doctest/doctest.h>

#include <cstring>
#include <map>

#include "core/base/error.h"
#include "core/io/exr_file.h"
#include "core/io/image_file.h"
#include "tests/io/image_builder.h"
#include "tests/io/scratch.h"

namespace etalon::io {
namespace {

using test::content_of;
using test::ScratchFolder;

std::string refusal(const std::string& file) {
  try {
    (void)decode_image(std::as_bytes(std::span(file.data(), file.size())), "f");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string little_endian(std::uint32_t value, int byte_count) {
  std::string bytes;
  for (int k = 0; k < byte_count; ++k) bytes += static_cast<char>(value >> (8 * k));
  return bytes;
}

/// Grey TIFF, 4 × 4 texels of 8 bits in one strip of 16 bytes without compression, with other values for the tags given; 0: without the tag.
std::string tiff(const std::map<std::uint32_t, std::uint32_t>& changes) {
  constexpr std::uint32_t kStripAt = 512;
  std::map<std::uint32_t, std::uint32_t> tags = {{256, 4},        {257, 4}, {258, 8}, {259, 1}, {262, 1},
                                                 {273, kStripAt}, {277, 1}, {278, 4}, {279, 16}};
  for (const auto& [tag, value] : changes) tags[tag] = value;
  std::erase_if(tags, [](const auto& entry) { return entry.second == 0; });
  std::string file = std::string("II*\0\x08\0\0\0", 8) + little_endian(static_cast<std::uint32_t>(tags.size()), 2);
  for (const auto& [tag, value] : tags) file += little_endian(tag, 2) + little_endian(4, 2) + little_endian(1, 4) + little_endian(value, 4);
  file.resize(kStripAt);
  return file + std::string(16, '\x55');
}

/// Baseline JPEG of one block of grey, its size and kind (0xC0 to 0xCF) as given, its one scan `scan_count` times.
std::string jpeg(int width, int height, unsigned char kind, int scan_count) {
  using namespace std::literals;
  std::string file = "\xff\xd8\xff\xdb\x00\x43\x00"s + std::string(64, '\1') + '\xff' + static_cast<char>(kind) + "\x00\x0b\x08"s;
  for (const int side : {height, width}) file += {static_cast<char>(side >> 8), static_cast<char>(side & 0xFF)};
  file += "\x01\x01\x11\x00"s;
  for (const char table : {'\x00', '\x10'}) file += "\xff\xc4\x00\x14"s + table + '\1' + std::string(16, '\0');
  for (int n = 0; n < scan_count; ++n) file += "\xff\xda\x00\x08\x01\x01\x00\x00\x3f\x00\x3f"s;
  return file + "\xff\xd9"s;
}

TEST_CASE("claims: TIFF sizes of image and tile against the file, by compression") {
  CHECK(refusal(tiff({})) == "");
  CHECK(refusal(tiff({{256, 32768}, {257, 32768}})) == "f: expected at least 268435456 bytes for the size of its image, got 528");
  CHECK(refusal(tiff({{256, 32768}, {257, 32768}, {259, 8}})) == "f: expected at least 1040447 bytes for the size of its image, got 528");
  CHECK(refusal(tiff({{256, 32768}, {257, 32768}, {259, 5}})) == "f: expected at least 419430 bytes for the size of its image, got 528");
  CHECK(refusal(tiff({{256, 32768}, {257, 32768}, {259, 32773}})) ==
        "f: expected at least 16777216 bytes for the size of its image, got 528");
  CHECK(refusal(tiff({{256, 32768}, {257, 32768}, {259, 50000}})) == "f: expected at least 32768 bytes for the size of its image, got 528");
  CHECK(refusal(tiff({{322, 32768}, {323, 32768}})) == "f: expected at least 268435456 bytes for the size of its tile, got 528");
  CHECK(refusal(tiff({{322, 32769}, {323, 16}})).find("tile width: expected 1 to 32768, got 32769") != std::string::npos);
}

TEST_CASE("claims: TIFF strips that are missing or short") {
  CHECK(refusal(tiff({{278, 2}})) == "f: strips: expected 2, got 1");
  CHECK(refusal(tiff({{284, 2}, {277, 3}})) == "f: strips: expected 3, got 1");
  CHECK(refusal(tiff({{279, 15}})).find(": strip 0: expected 16 bytes, got 15") != std::string::npos);
  CHECK(refusal(tiff({{257, 5}, {278, 5}})).find(": strip 0: expected 20 bytes, got 16") != std::string::npos);
  // Where the number of bytes or of rows is not said, the decoder takes what there is: one strip of all rows.
  CHECK(refusal(tiff({{278, 0}})) == "");
}

TEST_CASE("claims: JPEG sizes against the file, and scans without end") {
  CHECK(refusal(jpeg(8, 8, 0xC0, 1)) == "");
  CHECK(refusal(jpeg(32768, 32768, 0xC0, 1)) == "f: expected at least 2097152 bytes for its size of 32768x32768, got 141");
  CHECK(refusal(jpeg(32768, 32768, 0xC2, 1)).find("f: expected at least 2097152 bytes") == 0);
  CHECK(refusal(jpeg(32768, 32768, 0xC9, 1)).find("f: expected at least 32768 bytes") == 0);
  CHECK(refusal(jpeg(8, 8, 0xC0, 501)).find("expected at most 500 scans") != std::string::npos);
}

TEST_CASE("claims: OpenEXR sizes against the file") {
  const ScratchFolder folder;
  write_image(folder / "a.exr", test::random_image(5, 4, {ChannelType::half, 4}, 1));
  std::string file = content_of(folder / "a.exr");
  CHECK(refusal(file) == "");
  for (const std::string& name : {std::string("dataWindow\0box2i\0", 18), std::string("displayWindow\0box2i\0", 21)}) {
    const std::size_t at = file.find(name.substr(0, name.size() - 1)) + name.size() - 1 + 4;
    const std::int32_t right = 32767;
    std::memcpy(file.data() + at + 8, &right, 4);
  }
  CHECK(refusal(file).find("f: expected at least 1016 bytes for its size and channels, got ") == 0);
}

}  // namespace
}  // namespace etalon::io
