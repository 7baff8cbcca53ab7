// Range images in PNG, TIFF and EXR: what is written comes back, what others write is read, bad files are refused.
#include "core/io/range_file.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include <doctest/doctest.h>

#include "core/io/exr_file.h"
#include "core/io/image_file.h"
#include "tests/io/scratch.h"

namespace etalon::io {
namespace {

using test::content_of;
using test::input_error;
using test::ScratchFolder;
using test::write_error;

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Equal where no sample equals no sample.
bool same(const RangeImage& a, const RangeImage& b) {
  if (a.width != b.width || a.height != b.height || a.spacing != b.spacing || a.z.size() != b.z.size()) return false;
  for (std::size_t i = 0; i < a.z.size(); ++i)
    if (a.z[i] != b.z[i] && !(std::isnan(a.z[i]) && std::isnan(b.z[i]))) return false;
  return true;
}

template <class T>
Image image_of(int width, int height, PixelFormat format, const std::vector<T>& values) {
  Image image(width, height, format);
  REQUIRE(image.bytes().size() == values.size() * sizeof(T));
  std::memcpy(image.bytes().data(), values.data(), image.bytes().size());
  return image;
}

const RangeImage kScan{.width = 3, .height = 2, .spacing = 0.8125, .z = {0.5f, kNone, 255.99609375f, 1, 2, 0.00390625f}};

std::string error(const std::filesystem::path& path, const RangeFileOptions& options) {
  const std::string message = input_error([&] { (void)read_range_image(path, options); });
  return message.starts_with(path.string()) ? message.substr(path.string().size()) : message;
}

TEST_CASE("range files: what is written comes back") {
  const ScratchFolder folder;
  for (const char* name : {"a.exr", "a.tif", "a.PNG"}) {
    CAPTURE(name);
    const bool png = std::string(name) == "a.PNG";
    const auto path = folder / name;
    write_range_image(path, kScan, 1.0 / 256);
    RangeFileOptions options{.depth_scale = png ? 1.0 / 256 : 1.0};
    if (std::string(name) != "a.exr") options.spacing = kScan.spacing;
    const LoadedRange loaded = read_range_image(path, options);
    CHECK(same(loaded.range, kScan));
    CHECK(loaded.notes.empty());
    CHECK(names_range_image(path));
  }
  CHECK(!names_range_image("scan.ply"));
  CHECK(!names_range_image("scan.jpg"));
  // The option is stronger than the file.
  CHECK(read_range_image(folder / "a.exr", {.spacing = 2}).range.spacing == 2);
}

TEST_CASE("range files: integers count as stored, 0 is no sample unless another number is") {
  const ScratchFolder folder;
  const auto path = folder / "d.png";
  write_image(path, image_of<std::uint16_t>(2, 2, {ChannelType::unorm16, 1}, {0, 1000, 65535, 3}));
  const RangeImage usual = read_range_image(path, {.spacing = 1, .depth_scale = 0.5}).range;
  CHECK(std::isnan(usual.z[0]));
  CHECK(usual.z[1] == 500);  // row 0 is the lowest
  CHECK(usual.z[2] == 32767.5f);
  const RangeImage other = read_range_image(path, {.spacing = 1, .depth_scale = -1, .no_data = 65535}).range;
  CHECK(other.z[0] == 0);
  CHECK(other.z[1] == -1000);
  CHECK(std::isnan(other.z[2]));
}

TEST_CASE("range files: real numbers; what is not finite or named is no sample") {
  const ScratchFolder folder;
  write_image(folder / "d.tif", image_of<float>(4, 1, kR32f, {kInfinity, -kInfinity, -9999, 0}));
  const RangeImage tiff = read_range_image(folder / "d.tif", {.spacing = 1, .no_data = -9999}).range;
  CHECK(sample_count(tiff) == 1);
  CHECK(tiff.z[3] == 0);
  write_image(folder / "h.exr", image_of<std::uint16_t>(3, 1, {ChannelType::half, 1}, {0x3C00, 0x7C00, 0x7E00}));  // 1, inf, NaN
  const RangeImage half = read_range_image(folder / "h.exr", {.spacing = 1, .depth_scale = 3}).range;
  CHECK(sample_count(half) == 1);
  CHECK(half.z[0] == 3);
}

TEST_CASE("range files: of an EXR the channel Z, else Y, else the only one") {
  const ScratchFolder folder;
  const auto layer = [](const char* name, float value) { return ExrLayer{{name}, image_of<float>(1, 1, kR32f, {value})}; };
  const auto read = [&](std::vector<ExrLayer> layers) {
    write_exr(folder / "d.exr", {std::move(layers), {}});
    return read_range_image(folder / "d.exr", {.spacing = 1}).range.z[0];
  };
  CHECK(read({layer("R", 1), layer("Y", 2), layer("Z", 3)}) == 3);
  CHECK(read({layer("R", 1), layer("Y", 2)}) == 2);
  CHECK(read({layer("depth", 4)}) == 4);
  write_exr(folder / "d.exr", {{layer("R", 1), layer("G", 2)}, {}});
  CHECK(error(folder / "d.exr", {.spacing = 1}) == ": expected a channel 'Z', got G, R");
  // A spacing that is no length is not one.
  write_exr(folder / "d.exr", {{layer("Z", 1)}, {{"rangeSpacing", "-1"}}});
  CHECK(error(folder / "d.exr", {}) == ": a range image: expected the spacing of its samples, got none");
}

TEST_CASE("range files: depths of 8 bits and planes are said") {
  const ScratchFolder folder;
  write_image(folder / "d.png", image_of<std::uint8_t>(2, 1, {ChannelType::unorm8, 1}, {7, 7}));
  const LoadedRange loaded = read_range_image(folder / "d.png", {.spacing = 1});
  REQUIRE(loaded.notes.size() == 2);
  CHECK(loaded.notes[0].find("d.png: depths of 8 bits") == 0);
  CHECK(loaded.notes[1] == "d.png: every sample has the depth 7: a plane");
  CHECK(loaded.range.z[0] == 7);
}

TEST_CASE("range files: refusals") {
  const ScratchFolder folder;
  const auto path = folder / "d.png";
  write_image(path, Image(2, 2, {ChannelType::unorm16, 1}));
  CHECK(error(path, {.spacing = 1}) == ": a range image: expected samples, got none in 2x2");
  CHECK(error(path, {}) == ": a range image: expected the spacing of its samples, got none");
  CHECK(error(path, {.spacing = 0}) == ": spacing: expected a length above 0, got 0");
  CHECK(error(path, {.spacing = kInfinity}) == ": spacing: expected a length above 0, got inf");
  CHECK(error(path, {.spacing = 1, .depth_scale = 0}) == ": depth scale: expected a number other than 0, got 0");
  CHECK(error(path, {.spacing = 1, .depth_scale = kNone}).find(": depth scale") == 0);
  write_image(path, Image(2, 2, {ChannelType::unorm16, 3}));
  CHECK(error(path, {.spacing = 1}) == ": a range image: expected one channel, got rgb unorm16");
  write_image(folder / "d.tif", image_of<float>(1, 1, kR32f, {3e38f}));
  CHECK(error(folder / "d.tif", {.spacing = 1, .depth_scale = 10}) == ": sample 0: expected a depth within float32, got 3e+38·10");
  write_image(path, Image(8193, 8192, {ChannelType::unorm8, 1}));
  CHECK(error(path, {.spacing = 1}) == ": a range image: expected at most 67108864 samples, got 8193x8192");
  CHECK(error(folder / "missing.png", {.spacing = 1}) == ": No such file or directory");
}

TEST_CASE("range files: cut short anywhere, a file is refused") {
  const ScratchFolder folder;
  for (const char* name : {"a.exr", "a.tif", "a.png"}) {
    CAPTURE(name);
    write_range_image(folder / name, kScan, 1.0 / 256);
    const std::string whole = content_of(folder / name);
    for (std::size_t size = 1; size < whole.size(); size += 7) {
      CAPTURE(size);
      const auto path = folder.put(name, whole.substr(0, size));
      CHECK(input_error([&] { (void)read_range_image(path, {.spacing = 1}); }) != "no error");
    }
  }
}

TEST_CASE("range files: what cannot be written") {
  const ScratchFolder folder;
  const auto refused = [&](const char* name, const RangeImage& range) {
    return write_error([&] { write_range_image(folder / name, range, 1.0 / 256); });
  };
  CHECK(refused("a.ply", kScan).find("expected .png, .tif, .tiff or .exr, got '.ply'") != std::string::npos);
  for (const float z : {0.0f, -1.0f, 256.0f, 0.3f}) {
    CAPTURE(z);
    CHECK(refused("a.png", {.width = 1, .height = 1, .z = {z}}).find("expected 1 to 65535 whole steps of 0.00390625") != std::string::npos);
  }
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("range files: colours as bytes") {
  using Bytes = std::vector<std::byte>;
  const auto bytes = [](std::initializer_list<int> values) {
    Bytes result;
    for (const int v : values) result.push_back(static_cast<std::byte>(v));
    return result;
  };
  CHECK(color_bytes(image_of<std::uint8_t>(2, 1, {ChannelType::unorm8, 1}, {7, 9}), "c") == bytes({7, 7, 7, 9, 9, 9}));
  CHECK(color_bytes(image_of<std::uint8_t>(1, 1, kRgba8, {1, 2, 3, 4}), "c") == bytes({1, 2, 3}));
  // 128.5/257 of a step: 65535 = 255·257, so 128 is below a half step and 129 above.
  CHECK(color_bytes(image_of<std::uint16_t>(1, 1, {ChannelType::unorm16, 3}, {128, 129, 65535}), "c") == bytes({0, 1, 255}));
  CHECK(color_bytes(image_of<float>(1, 1, {ChannelType::float32, 3}, {-1, 0.5f, kInfinity}), "c") == bytes({0, 128, 255}));
  CHECK(input_error([&] { (void)color_bytes(image_of<float>(1, 1, kR32f, {kNone}), "c"); }) == "c: colours: expected numbers, got a NaN");
  CHECK(input_error([&] { (void)color_bytes(Image(1, 1, kRg32f), "c"); }) == "c: colours: expected grey, rgb or rgba, got rg float32");
  CHECK(input_error([&] { (void)color_bytes(Image(1, 1, kR32ui), "c"); }) == "c: colours: expected grey, rgb or rgba, got r uint32");
  CHECK(input_error([&] { (void)color_bytes(Image(), "c"); }) == "c: colours: expected grey, rgb or rgba, got none");
}

}  // namespace
}  // namespace etalon::io
