#include "core/io/exr_file.h"

#include <doctest/doctest.h>

#include "core/io/image_file.h"
#include "tests/io/image_builder.h"
#include "tests/io/scratch.h"

namespace etalon::io {
namespace {

using test::input_error;
using test::random_image;
using test::ScratchFolder;
using test::write_error;

ExrContent margins() {
  ExrContent content;
  content.layers.push_back({{"R", "G", "B", "A"}, random_image(9, 40, {ChannelType::half, 4}, 1)});
  content.layers.push_back({{"id.triangle"}, random_image(9, 40, kR32ui, 2)});
  content.layers.push_back({{"margin.u", "margin.v"}, random_image(9, 40, kRg32f, 3)});
  content.layers.push_back({{"Z"}, random_image(9, 40, kR32f, 4)});
  content.attributes = {{"drawListSha256", "abc"}, {"note", std::string(3000, 'x')}};
  return content;
}

TEST_CASE("exr: named channels of three types and header text come back bit by bit") {
  const ScratchFolder folder;
  const ExrContent content = margins();
  write_exr(folder / "a.exr", content);
  const ExrContent back = read_exr(folder / "a.exr");
  REQUIRE(back.layers.size() == 8);
  CHECK(back.layers[0].channel_names == std::vector<std::string>{"A"});  // ascending names
  for (const ExrLayer& layer : content.layers) CHECK(channels_image(back, layer.channel_names, "a.exr") == layer.image);
  CHECK(back.attributes == content.attributes);
  CHECK(read_image(folder / "a.exr") == content.layers[0].image);
}

TEST_CASE("exr: the same content gives the same bytes") {
  const ScratchFolder folder;
  write_exr(folder / "a.exr", margins());
  write_exr(folder / "b.exr", margins());
  CHECK(test::content_of(folder / "a.exr") == test::content_of(folder / "b.exr"));
}

TEST_CASE("exr: colour of half beside float is widened, every half exactly") {
  ExrContent content;
  Image halves(256, 256, {ChannelType::half, 1});
  for (int i = 0; i < 65536; ++i) halves.channels<std::uint16_t>(i % 256, i / 256)[0] = static_cast<std::uint16_t>(i);
  content.layers.push_back({{"R"}, halves});
  content.layers.push_back({{"G"}, Image(256, 256, kR32f)});
  const Image wide = color_image(content, "x");
  REQUIRE(wide.format() == kRg32f);
  CHECK(wide.channels<float>(0x3C00 % 256, 0x3C00 / 256)[0] == 1.0f);
  CHECK(wide.channels<float>(1, 0)[0] == 0x1p-24f);
  CHECK(wide.channels<float>(0x7BFF % 256, 0x7BFF / 256)[0] == 65504.0f);
}

TEST_CASE("exr: colour is RGBA, else what there is of it, else Y, else an error with the list") {
  const auto names = [](std::vector<std::string> channel_names) {
    ExrContent content;
    for (const std::string& n : channel_names) content.layers.push_back({{n}, Image(1, 1, kR32f)});
    return content;
  };
  CHECK(color_image(names({"A", "B", "G", "R", "Z"}), "f").format().channels == 4);
  CHECK(color_image(names({"B", "G", "R"}), "f").format().channels == 3);
  CHECK(color_image(names({"Y", "Z"}), "f").format().channels == 1);
  CHECK(input_error([&] { (void)color_image(names({"U", "Z"}), "f"); }) == "f: expected colour channels R, RG, RGB, RGBA or Y, got U, Z");
  CHECK(input_error([&] { (void)channels_image(names({"U"}), {"V"}, "f"); }) == "f: expected a channel 'V', got U");
  ExrContent mixed = names({"R"});
  mixed.layers.push_back({{"G"}, Image(1, 1, kR32ui)});
  CHECK(input_error([&] { (void)color_image(mixed, "f"); }) == "f: expected channels of like type, got uint32 beside real ones");
}

TEST_CASE("exr: contents that cannot be written are refused and leave no file") {
  const ScratchFolder folder;
  const std::string path = (folder / "a.exr").string();
  const auto error = [&](const ExrContent& content) { return write_error([&] { write_exr(path, content); }).substr(path.size()); };
  const Image r(2, 2, kR32f);
  CHECK(error({}) == ": cannot write: expected at least one channel, got none");
  CHECK(error({{{{"R"}, Image()}}, {}}) == ": cannot write: expected an image, got an empty one");
  CHECK(error({{{{"R"}, r}, {{"G"}, Image(2, 3, kR32f)}}, {}}) == ": cannot write: layers: expected 2x2, got 2x3");
  CHECK(error({{{{"R", "G"}, r}}, {}}) == ": cannot write: channel names: expected 1, got 2");
  CHECK(error({{{{"R"}, r}, {{"R"}, r}}, {}}) == ": cannot write: channel 'R' is there twice");
  CHECK(error({{{{""}, r}}, {}}) == ": cannot write: channel name: expected 1 to 255 bytes, got 0");
  CHECK(error({{{{std::string(256, 'n')}, r}}, {}}) == ": cannot write: channel name: expected 1 to 255 bytes, got 256");
  CHECK(error({{{{"R"}, r}}, {{"dataWindow", "text"}}}).starts_with(": cannot write: "));
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("exr: other files, absurd sizes") {
  const ScratchFolder folder;
  CHECK(input_error([&] { (void)read_exr(folder.put("a.exr", "not exr")); }) ==
        (folder / "a.exr").string() + ": byte 0: expected OpenEXR's magic number 76 2f 31 01");
  write_exr(folder / "b.exr", {{{{"R"}, Image(2, 2, kR32f)}}, {}});
  std::string content = test::content_of(folder / "b.exr");
  const std::size_t window = content.find("dataWindow") + 10 + 1 + 5 + 1 + 4;  // name, type, size; then xMin yMin xMax yMax
  content[window + 10] = 1;                                                    // xMax = 65537
  CHECK(input_error([&] { (void)read_exr(folder.put("b.exr", content)); }).find("image size: expected 1x1 to 32768x32768, got 65538x2") !=
        std::string::npos);
}

}  // namespace
}  // namespace etalon::io
