#include "core/io/image_file.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include "core/io/inputs.h"
#include "tests/io/image_builder.h"
#include "tests/io/scratch.h"

namespace etalon::io {
namespace {

using test::input_error;
using test::png_chunk;
using test::png_file;
using test::random_image;
using test::ScratchFolder;
using test::write_error;

std::string values(const Image& image) {
  std::string text = to_string(image.format()) + ":";
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      for (int c = 0; c < image.format().channels; ++c)
        text += " " + std::to_string(bytes_per_channel(image.format().type) == 2 ? image.channels<std::uint16_t>(x, y)[c]
                                                                                 : image.channels<std::uint8_t>(x, y)[c]);
  return text;
}

TEST_CASE("image file: every format that a file type holds comes back bit by bit, transparent texels with colour included") {
  const ScratchFolder folder;
  std::uint64_t seed = 1;
  const auto check = [&](const char* name, PixelFormat format) {
    const Image image = random_image(7, 5, format, seed++);
    write_image(folder / name, image);
    const Image back = read_image(folder / name);
    CHECK_MESSAGE(back == image, name << " " << to_string(format) << " came back as " << to_string(back.format()));
  };
  for (const int channels : {1, 3, 4})
    for (const ChannelType type : {ChannelType::unorm8, ChannelType::unorm16}) check("a.png", {type, channels});
  for (int channels = 1; channels <= 4; ++channels) {
    for (const ChannelType type : {ChannelType::unorm8, ChannelType::unorm16, ChannelType::half, ChannelType::float32, ChannelType::uint32})
      check("a.tif", {type, channels});
    for (const ChannelType type : {ChannelType::half, ChannelType::float32, ChannelType::uint32}) check("a.exr", {type, channels});
  }
}

TEST_CASE("image file: a TIFF file of signed 16 bit, as heights come, is read as those numbers") {
  const ScratchFolder folder;
  const std::string path = (folder / "a.tif").string();
  const std::vector<std::int16_t> numbers{-32768, -1, 0, 1, 4478, 32767};
  const auto output = OIIO::ImageOutput::create("tiff");
  REQUIRE(output->open(path, OIIO::ImageSpec(3, 2, 1, OIIO::TypeDesc::INT16)));
  REQUIRE(output->write_image(OIIO::TypeDesc::INT16, numbers.data()));
  REQUIRE(output->close());
  const Image image = read_image(path);
  REQUIRE(image.format() == kR32f);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) CHECK(image.channels<float>(x, y)[0] == numbers[static_cast<std::size_t>(3 * (1 - y) + x)]);
}

TEST_CASE("image file: no time of day in a TIFF file, so that an image has one file") {
  const ScratchFolder folder;
  write_image(folder / "a.tif", random_image(4, 4, kRgb8, 1));
  const FileBytes file = read_file(folder / "a.tif");
  // Tag 306, DateTime, of type 2: one character, the final zero.
  const std::string entry("\x32\x01\x02\x00\x01\x00\x00\x00\x00", 9);
  CHECK(file.text().substr(0, 2) == "II");
  CHECK(file.text().find(entry) != std::string_view::npos);
}

TEST_CASE("image file: all 65,536 pairs of colour and alpha survive PNG") {
  const ScratchFolder folder;
  Image image(256, 256, kRgba8);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      auto* t = image.channels<std::uint8_t>(x, y);
      t[0] = static_cast<std::uint8_t>(x);
      t[1] = static_cast<std::uint8_t>(255 - x);
      t[2] = static_cast<std::uint8_t>(x ^ y);
      t[3] = static_cast<std::uint8_t>(y);
    }
  for (const char* name : {"a.png", "a.TIFF"}) {
    write_image(folder / name, image);
    CHECK(read_image(folder / name) == image);
  }
}

TEST_CASE("image file: the top row of the file is our last") {
  const ScratchFolder folder;
  const auto path = folder.put("rows.png", png_file(1, 3, 8, 0, {"\x10", "\x20", "\x30"}));
  CHECK(values(read_image(path)) == "r unorm8: 48 32 16");
}

TEST_CASE("image file: what PNG knows and we do not is expanded") {
  const ScratchFolder folder;
  const auto read = [&](const std::string& content) { return values(read_image(folder.put("a.png", content))); };
  using namespace std::literals;
  CHECK(read(png_file(2, 1, 8, 4, {"\x05\x80\x06\xff"})) == "rgba unorm8: 5 5 5 128 6 6 6 255");
  CHECK(read(png_file(1, 1, 16, 4, {"\x01\x02\x03\x04"})) == "rgba unorm16: 258 258 258 772");
  CHECK(read(png_file(8, 1, 1, 0, {"\xA5"})) == "r unorm8: 255 0 255 0 0 255 0 255");
  CHECK(read(png_file(2, 1, 4, 0, {"\x0F"})) == "r unorm8: 0 255");
  const std::string palette = png_chunk("PLTE", "\x01\x02\x03\x0A\x0B\x0C");
  CHECK(read(png_file(2, 1, 8, 3, {"\x01\x00"s}, palette)) == "rgb unorm8: 10 11 12 1 2 3");
  CHECK(read(png_file(2, 1, 8, 3, {"\x01\x00"s}, palette + png_chunk("tRNS", "\x40"))) == "rgba unorm8: 10 11 12 255 1 2 3 64");
}

TEST_CASE("image file: srgb8 is written as its bytes") {
  const ScratchFolder folder;
  const Image image = random_image(3, 2, {ChannelType::srgb8, 3}, 5);
  write_image(folder / "a.png", image);
  const Image back = read_image(folder / "a.png");
  CHECK(back.format() == kRgb8);
  CHECK(std::equal(back.bytes().begin(), back.bytes().end(), image.bytes().begin(), image.bytes().end()));
}

TEST_CASE("image file: JPEG, grey and colour; the content decides, not the extension") {
  const ScratchFolder folder;
  for (const int channels : {1, 3}) {
    std::vector<unsigned char> grey(16 * 8 * static_cast<std::size_t>(channels), 77);
    const auto output = OIIO::ImageOutput::create("jpeg");
    REQUIRE(output);
    REQUIRE(output->open((folder / "a.png").string(), OIIO::ImageSpec(16, 8, channels, OIIO::TypeDesc::UINT8)));
    REQUIRE(output->write_image(OIIO::TypeDesc::UINT8, grey.data()));
    REQUIRE(output->close());
    const Image image = read_image(folder / "a.png");
    CHECK(image.width() == 16);
    CHECK(image.height() == 8);
    CHECK(image.format() == PixelFormat{ChannelType::unorm8, channels});
    // Flat grey is a DC term of 8 · (77 − 128) and no colour difference: exact whatever the quantum of the default quality, 1.
    CHECK(image.channels<std::uint8_t>(3, 3)[0] == 77);
  }
}

TEST_CASE("image file: what is not an image, or not one of ours, is refused in one line") {
  const ScratchFolder folder;
  const auto error = [&](const char* name, const std::string& content) {
    const auto path = folder.put(name, content);
    const std::string message = input_error([&] { (void)read_image(path); });
    REQUIRE(message.starts_with(path.string()));
    return message.substr(path.string().size());
  };
  CHECK(error("a.png", "GIF89a....") == ": image format: expected PNG, JPEG, TIFF or OpenEXR, got a file that begins with 'GIF89a..'");
  CHECK(error("a.png", "") == ": the file is empty");
  CHECK(error("a.png", png_file(32769, 1, 8, 0, {"x"})) == ": byte 33: image size: expected 1x1 to 32768x32768, got 32769x1");
  CHECK(error("a.png", png_file(0, 1, 8, 0, {"x"})) == ": byte 33: image size: expected 1x1 to 32768x32768, got 0x1");
  CHECK(error("a.png", png_file(32768, 32768, 8, 0, {"x"})).find("expected at least 130055 bytes for its size") != std::string::npos);
  std::string bad_checksum = png_file(1, 1, 8, 0, {"x"});
  bad_checksum[45] = static_cast<char>(bad_checksum[45] ^ 1);
  CHECK(error("a.png", bad_checksum).find("chunk IDAT: checksum: expected") != std::string::npos);
  CHECK(input_error([&] { (void)read_image(folder / "none.png"); }) == (folder / "none.png").string() + ": No such file or directory");
  CHECK(input_error([&] { (void)read_image(folder.path()); }) == folder.path().string() + ": expected a file, got a folder");
}

TEST_CASE("image file: TIFF of too many channels or of signed integers is refused") {
  const ScratchFolder folder;
  const auto error = [&](int channels, OIIO::TypeDesc type) {
    const std::string path = (folder / "a.tif").string();
    const std::vector<float> zeros(64, 0);
    const auto output = OIIO::ImageOutput::create("tiff");
    REQUIRE(output->open(path, OIIO::ImageSpec(2, 2, channels, type)));
    REQUIRE(output->write_image(OIIO::TypeDesc::FLOAT, zeros.data()));
    REQUIRE(output->close());
    const std::string message = input_error([&] { (void)read_image(path); });
    return message.starts_with(path) ? message.substr(path.size()) : message;
  };
  CHECK(error(5, OIIO::TypeDesc::UINT8) == ": image channels: expected 1 to 4, got 5");
  CHECK(error(1, OIIO::TypeDesc::INT8) == ": channel type: expected 8 bit unsigned, 16 bit, half, float or uint32, got int8");
  CHECK(error(1, OIIO::TypeDesc::DOUBLE) == "no error");
}

TEST_CASE("image file: what a format cannot hold is refused and nothing is written") {
  const ScratchFolder folder;
  const auto error = [&](const char* name, const Image& image) {
    return write_error([&] { write_image(folder / name, image); }).substr((folder / name).string().size());
  };
  CHECK(error("a.png", Image(1, 1, kRg32f)) == ": cannot write: PNG holds r, rgb or rgba of unorm8 or unorm16, got rg float32");
  CHECK(error("a.png", Image(1, 1, {ChannelType::unorm8, 2})) ==
        ": cannot write: PNG holds r, rgb or rgba of unorm8 or unorm16, got rg unorm8");
  CHECK(error("a.exr", Image(1, 1, kRgba8)) == ": cannot write: EXR holds half, float32 or uint32, got rgba unorm8");
  CHECK(error("a.gif", Image(1, 1, kRgba8)) == ": cannot write: image format: expected .png, .tif, .tiff or .exr, got '.gif'");
  CHECK(error("a.png", Image()) == ": cannot write: expected an image, got an empty image");
  CHECK(folder.entry_count() == 0);
  CHECK(error("none/a.png", Image(1, 1, kRgba8)) == ": cannot write: No such file or directory");
}

}  // namespace
}  // namespace etalon::io
