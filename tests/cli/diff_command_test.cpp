// etalon diff as its users call it: idiff's options and codes, classes by a device, folders, documents, waivers, refusals.
#include <cmath>
#include <cstdlib>
#include <limits>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "core/io/exr_file.h"
#include "core/io/image_file.h"
#include "tests/cli/run_command.h"
#include "tests/cli/schema_validator.h"
#include "tests/support/skip.h"

using namespace etalon;
using namespace etalon::test;
using nlohmann::json;

namespace {

// 4 × 4 grey; `value` at (2, 1).
void write_grey(const std::filesystem::path& path, std::uint8_t value, int width = 4) {
  Image image(width, 4, kRgb8);
  for (std::byte& byte : image.bytes()) byte = std::byte{100};
  image.channels<std::uint8_t>(2, 1)[2] = value;
  io::write_image(path, image);
}

CommandResult diff(const ScratchFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "diff");
  return run_etalon(arguments, {.folder = folder.path()});
}

json diff_document(const ScratchFolder& folder, std::vector<std::string> arguments, int exit_code) {
  arguments.insert(arguments.end(), {"--json", "-"});
  const CommandResult result = diff(folder, arguments);
  CAPTURE(result.err);
  REQUIRE(result.exit_code == exit_code);
  json document = json::parse(result.out);
  const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/diff.json"));
  for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
  return document;
}

// A textured square seen in perspective: golden.exr with its draws, and golden.png.
void write_golden(const ScratchFolder& folder, const std::string& size = "64") {
  folder.file("square.obj", square_obj());
  for (const std::string output : {"golden.exr", "golden.png"}) {
    std::vector<std::string> arguments{"render", "square.obj", "--size", size, "--view", "9/24", "-o", output};
    if (output == "golden.exr") arguments.insert(arguments.end(), {"--margins", "--write-draws", "golden.draws"});
    REQUIRE(run_etalon(arguments, {.folder = folder.path()}).exit_code == 0);
  }
}

// golden.png with `change` applied.
template <class Change>
void write_candidate(const ScratchFolder& folder, const std::string& name, const Change& change) {
  Image image = io::read_image(folder.path() / "golden.png");
  change(image);
  io::write_image(folder.path() / name, image);
}

}  // namespace

TEST_CASE("diff: idiff's options, with one dash or two, and its codes") {
  const ScratchFolder folder;
  write_grey(folder.path() / "a.png", 100);
  write_grey(folder.path() / "b.png", 140);  // 40 / 255 = 0.157 in one of 16 texels
  write_grey(folder.path() / "c.png", 100, 5);
  CHECK(diff(folder, {"a.png", "a.png"}).exit_code == 0);
  CHECK(diff(folder, {"a.png", "b.png"}).exit_code == 2);
  CHECK(diff(folder, {"a.png", "c.png"}).exit_code == 3);
  CHECK(diff(folder, {"a.png", "none.png"}).exit_code == 4);
  for (const std::string dash : {"-", "--"}) {
    CHECK(diff(folder, {dash + "fail", "0.157", "a.png", "b.png"}).exit_code == 0);
    CHECK(diff(folder, {dash + "fail", "0.156", "a.png", "b.png"}).exit_code == 2);
    CHECK(diff(folder, {dash + "failpercent", "6.25", "a.png", "b.png"}).exit_code == 1);  // idiff warns too: over the warning threshold
    CHECK(diff(folder, {dash + "failpercent", "6.25", dash + "warnpercent", "6.25", "a.png", "b.png"}).exit_code == 0);
    CHECK(diff(folder, {dash + "fail=1", dash + "warn", "0.004", "a.png", "b.png"}).exit_code == 1);
    CHECK(diff(folder, {dash + "fail", "1", dash + "hardfail", "0.1", "a.png", "b.png"}).exit_code == 2);
    CHECK(diff(folder, {dash + "allowfailures", "1", "a.png", "b.png"}).exit_code == 0);
    CHECK(diff(folder, {dash + "failrelative", "0.34", "a.png", "b.png"}).exit_code == 0);
  }
  const CommandResult said = diff(folder, {"a.png", "b.png", "--texel", "2,1"});
  CHECK(said.out.find("max error 0.156863 at (2, 1) B") != std::string::npos);
  CHECK(said.out.find("would pass: --fail 0.1568") != std::string::npos);
  CHECK(said.out.find("--failpercent 6.25 --warnpercent 6.25,") != std::string::npos);  // the test above: no warning then
  CHECK(said.out.find("--allowfailures 1") != std::string::npos);
  CHECK(said.out.find("texel (2, 1): golden 100 100 100 (rgb unorm8), candidate 100 100 140") != std::string::npos);
  CHECK(said.out.find("FAILURE") != std::string::npos);
}

TEST_CASE("diff: the picture of the differences") {
  const ScratchFolder folder;
  write_grey(folder.path() / "a.png", 100);
  write_grey(folder.path() / "b.png", 90);
  CHECK(diff(folder, {"a.png", "a.png", "-o", "d.png", "-od"}).exit_code == 0);
  CHECK(!std::filesystem::exists(folder.path() / "d.png"));
  CHECK(diff(folder, {"a.png", "b.png", "-o", "d.png", "-od", "-abs", "-scale", "10"}).exit_code == 2);
  CHECK(io::read_image(folder.path() / "d.png").channels<std::uint8_t>(2, 1)[2] == 100);
  CHECK(diff(folder, {"a.png", "b.png", "-o", "d.exr"}).exit_code == 2);
  CHECK(io::read_image(folder.path() / "d.exr").channels<float>(2, 1)[2] == static_cast<float>(-10.0 / 255));
}

TEST_CASE("diff: documents") {
  const ScratchFolder folder;
  write_grey(folder.path() / "a.png", 100);
  write_grey(folder.path() / "b.png", 140);
  write_grey(folder.path() / "c.png", 100, 5);
  const json same = diff_document(folder, {"a.png", "a.png"}, 0);
  CHECK(same["jobs"][0]["pixels"]["psnr_db"].is_null());
  CHECK(same["jobs"][0]["pixels"]["identical"] == true);
  const json other = diff_document(folder, {"a.png", "b.png", "--junit", "j.xml", "--html", "h.html"}, 2);
  CHECK(other["verdict"] == "failure");
  CHECK(other["jobs"][0]["pixels"]["max_at"] == json({2, 1}));
  CHECK(other["jobs"][0]["pixels"]["would_pass"]["failpercent"] == 6.25);
  CHECK(diff_document(folder, {"a.png", "c.png"}, 3)["jobs"][0]["problem"] == "sizes differ: golden 4x4, candidate 5x4");
  const std::string junit = read_text(folder.path() / "j.xml");
  CHECK(junit.find("<testsuite name=\"etalon diff\" tests=\"1\" failures=\"1\" errors=\"0\">") != std::string::npos);
  CHECK(junit.find("<failure message=\"mean error") != std::string::npos);
  const std::string page = read_text(folder.path() / "h.html");
  CHECK(page.find("type=\"range\"") != std::string::npos);
  CHECK(page.find("Histogram of differences") != std::string::npos);
  CHECK(page.find("CPU, exact") == std::string::npos);
  CHECK(page.find("http") == std::string::npos);
  std::string first;
  for (const char* threads : {"1", "2", "7"}) {
    json document = diff_document(folder, {"a.png", "b.png", "--threads", threads}, 2);
    document.erase("run");
    if (first.empty()) first = document.dump();
    CHECK(document.dump() == first);
  }
}

TEST_CASE("diff: folders by relative name; what is missing fails, what cannot be read does not end it") {
  const ScratchFolder folder;
  for (const char* name : {"g", "g/sub", "c", "c/sub", "empty"}) std::filesystem::create_directory(folder.path() / name);
  for (const char* name : {"g/a.png", "c/a.png", "g/sub/b.png", "c/sub/b.png"}) write_grey(folder.path() / name, 100);
  folder.file("g/notes.txt", "no picture");
  CHECK(diff(folder, {"g", "c"}).exit_code == 0);
  write_grey(folder.path() / "g/only.png", 100);
  write_grey(folder.path() / "c/new.png", 100);
  const json document = diff_document(folder, {"g", "c", "--junit", "j.xml"}, 2);
  REQUIRE(document["jobs"].size() == 4);
  CHECK(document["jobs"][0]["job"] == "a.png");
  CHECK(document["jobs"][1]["status"] == "only_candidate");
  CHECK(document["jobs"][2]["status"] == "only_golden");
  CHECK(document["jobs"][3]["job"] == "sub/b.png");
  // new.tif also takes new.png; a texture beside a FILE.draws is no picture.
  io::write_image(folder.path() / "g/new.tif", io::read_image(folder.path() / "c/new.png"));
  write_grey(folder.path() / "g/drawn.0.png", 100);
  folder.file("g/drawn.draws", "any");
  const json paired = diff_document(folder, {"g", "c"}, 2);
  REQUIRE(paired["jobs"].size() == 4);
  CHECK(paired["jobs"][1]["job"] == "new.tif");
  CHECK(paired["jobs"][1]["status"] == "compared");
  CHECK(paired["jobs"][2]["status"] == "only_golden");
  folder.file("c/a.png", "not a picture");
  CHECK(diff_document(folder, {"g", "c"}, 4)["jobs"][0]["status"] == "unreadable");
  check_refused({"diff", "empty", "empty"}, 4, folder, "expected pictures");
  check_refused({"diff", "g", "c/new.png"}, 64, folder, "two pictures or two folders");
  check_refused({"diff", "g", "c", "-o", "d.png"}, 64, folder, "not of two folders");
}

TEST_CASE("diff: folders behind links are compared too") {
  const ScratchFolder folder;
  for (const char* name : {"golden", "candidate", "g", "c"}) std::filesystem::create_directory(folder.path() / name);
  write_grey(folder.path() / "golden/a.png", 100);
  write_grey(folder.path() / "candidate/a.png", 120);
  std::filesystem::create_directory_symlink("../golden", folder.path() / "g/link");
  std::filesystem::create_directory_symlink("../candidate", folder.path() / "c/link");
  CHECK(diff(folder, {"g", "c"}).exit_code == 2);
}

TEST_CASE("diff --device: classes by the draws that the golden names") {
  const ScratchFolder folder;
  write_golden(folder);
  const json same = diff_document(folder, {"golden.exr", "golden.png", "--device", "contract"}, 0);
  CHECK(same["jobs"][0]["device"]["by_draws"] == true);
  CHECK(same["jobs"][0]["identical"] == 4096);
  CHECK(same["jobs"][0]["pixels"]["differing"] == 0);  // of the golden as it is in the candidate's format
  CHECK(same["total"]["unexplained"] == 0);

  write_candidate(folder, "wrong.png", [](Image& image) { image.channels<std::uint8_t>(32, 32)[0] ^= 0x40; });
  const json wrong = diff_document(folder, {"golden.exr", "wrong.png", "--device", "llvmpipe", "--texel", "32,32"}, 2);
  CHECK(wrong["jobs"][0]["unexplained"] == 1);
  CHECK(wrong["jobs"][0]["worst"][0]["x"] == 32);
  CHECK(wrong["jobs"][0]["texel"].get<std::string>().find("UNEXPLAINED (value)") != std::string::npos);
  CHECK(wrong["jobs"][0]["diagnosis"].get<std::string>().find("isolated wrong bytes") != std::string::npos);
  CHECK(diff(folder, {"golden.png", "wrong.png", "--device", "d3d11", "--draws", "golden.draws", "--allowfailures", "1"}).exit_code == 0);

  // The top row of a picture first: every texel of the square is elsewhere.
  write_candidate(folder, "flipped.png", [](Image& image) { image = flipped_rows(image); });
  const json flipped = diff_document(folder, {"golden.exr", "flipped.png", "--device", "vulkan:8:12"}, 2);
  CHECK(flipped["jobs"][0]["causes"][0]["name"] == "picture upside down");
  CHECK(flipped["jobs"][0]["causes"][0]["explained_share"].get<double>() > 0.98);
  CHECK(flipped["jobs"][0]["patterns"].empty());
}

TEST_CASE("diff --device: what OpenGL draws of the golden's draws is explained") {
  const ScratchFolder folder;
  write_golden(folder, "200");
  const CommandResult drawn = run_etalon({"render", "golden.draws", "--backend", "gl", "-o", "candidate.png"}, {.folder = folder.path()});
  if (drawn.exit_code == 1) return report_skip("diff of what OpenGL draws", drawn.err);
  REQUIRE(drawn.exit_code == 0);
  const json document = diff_document(folder, {"golden.exr", "candidate.png", "--device", "llvmpipe"}, 0);
  CHECK(document["jobs"][0]["unexplained"] == 0);
  CHECK(document["jobs"][0]["tie?"] == 0);
}

TEST_CASE("diff --device: with the pictures alone a tie is only perhaps one") {
  const ScratchFolder folder;
  write_golden(folder);
  write_candidate(folder, "near.png", [](Image& image) {
    std::uint8_t& byte = image.channels<std::uint8_t>(32, 32)[0];
    byte = static_cast<std::uint8_t>(byte == 255 ? 254 : byte + 1);
  });
  std::filesystem::create_directory(folder.path() / "alone");
  std::filesystem::copy(folder.path() / "golden.png", folder.path() / "alone" / "golden.png");
  const json document = diff_document(folder, {"alone/golden.png", "near.png", "--device", "llvmpipe"}, 1);
  CHECK(document["jobs"][0]["tie?"] == 1);
  CHECK(document["jobs"][0]["unexplained"] == 0);
  CHECK(document["jobs"][0]["device"]["by_draws"] == false);
  CHECK(diff(folder, {"alone/golden.png", "near.png", "--device", "llvmpipe"}).out.find("not proven") != std::string::npos);
}

TEST_CASE("diff: of OpenEXR files every channel that both have") {
  const ScratchFolder folder;
  const auto write = [&](const std::string& name, const std::string& color, float z, bool with_margin) {
    const Image grey(3, 2, kR32f);
    Image depth(3, 2, kR32f);
    depth.channels<float>(1, 1)[0] = z;
    io::ExrContent content{{{{color + "R"}, grey}, {{color + "G"}, grey}, {{color + "B"}, grey}, {{"Z"}, depth}}, {}};
    if (with_margin) content.layers.push_back({{"margin.z"}, depth});
    io::write_exr(folder.path() / name, content);
  };
  write("a.exr", "", 0.5f, true);
  write("b.exr", "", 0.75f, false);
  const json job = diff_document(folder, {"a.exr", "b.exr"}, 2)["jobs"][0];
  CHECK(job["verdict"] == "failure");
  CHECK(job["note"] == "channel Z: 1 of 6 values differ, by at most 0.25");
  CHECK(diff(folder, {"a.exr", "b.exr", "--fail", "0.3"}).exit_code == 0);
  CHECK(diff(folder, {"a.exr", "a.exr"}).exit_code == 0);
  // Layers, and names that nobody has heard of.
  write("layer.exr", "beauty.", 0.5f, false);
  write("other.exr", "beauty.", 1, true);
  CHECK(diff(folder, {"layer.exr", "layer.exr"}).exit_code == 0);
  CHECK(diff(folder, {"layer.exr", "other.exr"}).exit_code == 2);
  io::write_exr(folder.path() / "odd.exr", {{{{"a"}, Image(2, 2, kR32f)}, {{"b"}, Image(2, 2, kR32ui)}}, {}});
  CHECK(diff(folder, {"odd.exr", "odd.exr"}).exit_code == 0);
}

TEST_CASE("diff --device: of the pictures alone, what is not finite is identical to itself and near nothing") {
  const ScratchFolder folder;
  const float inf = std::numeric_limits<float>::infinity();
  const auto write = [&](const std::string& name, float first, float second) {
    Image image(2, 1, PixelFormat{ChannelType::float32, 3});
    for (int c = 0; c < 3; ++c) image.channels<float>(0, 0)[c] = first, image.channels<float>(1, 0)[c] = second;
    io::write_image(folder.path() / name, image);
  };
  const auto unexplained = [&](const std::string& a, const std::string& b, int exit_code) {
    const json job = diff_document(folder, {a, b, "--device", "gl"}, exit_code)["jobs"][0];
    CHECK(job["tie?"] == 0);
    return job["unexplained"].get<int>();
  };
  write("nan.exr", std::nanf(""), inf);
  write("same.exr", std::nanf(""), inf);
  write("other.exr", 0.5f, -inf);
  write("number.exr", 0.5f, 3);
  CHECK(unexplained("nan.exr", "same.exr", 0) == 0);
  CHECK(unexplained("nan.exr", "other.exr", 2) == 2);
  CHECK(unexplained("other.exr", "number.exr", 2) == 1);
  CHECK(unexplained("number.exr", "other.exr", 2) == 1);
}

TEST_CASE("diff --device: draws that do not fit are refused") {
  const ScratchFolder folder;
  write_golden(folder);
  write_candidate(folder, "changed.png", [](Image& image) { image.channels<std::uint8_t>(5, 5)[0] ^= 1; });
  check_refused({"diff", "changed.png", "golden.png", "--device", "d3d11", "--draws", "golden.draws"}, 4, folder,
                "expected the picture that golden.draws gives, got 1 texels");
  check_refused({"diff", "golden.exr", "golden.png", "--device", "vulkan:4"}, 4, folder, "draw the golden with --snap-bits 4");
  REQUIRE(run_etalon({"render", "square.obj", "--size", "32", "--write-draws", "small.draws", "-o", "small.png"}, {.folder = folder.path()})
              .exit_code == 0);
  check_refused({"diff", "golden.png", "golden.png", "--device", "d3d11", "--draws", "small.draws"}, 4, folder,
                "expected the 32x32 of small.draws");
  check_refused({"diff", "golden.exr", "golden.png", "--device", "d3d11", "--draws", "small.draws"}, 4, folder, "expected the draw list");
  REQUIRE(run_etalon({"render", "square.obj", "--size", "32", "--snap-bits", "4", "--write-draws", "coarse.draws", "-o", "coarse.png"},
                     {.folder = folder.path()})
              .exit_code == 0);
  CHECK(diff(folder, {"coarse.png", "coarse.png", "--device", "vulkan:4"}).exit_code == 0);
}

TEST_CASE("diff --waivers: a reason, a device, an end; one that covers nothing fails") {
  const ScratchFolder folder;
  write_golden(folder);
  write_candidate(folder, "wrong.png", [](Image& image) { image.channels<std::uint8_t>(32, 32)[0] ^= 0x40; });
  const auto with = [&](const std::string& pair, const std::string& device, const std::string& expires, const std::string& candidate) {
    folder.file("w.json", R"({"schema":"etalon/waivers/1","waivers":[{"pair":")" + pair + R"(","device":")" + device +
                              R"(","reason":"known","expires":")" + expires + R"(","texels":1}]})");
    return diff(folder, {"golden.exr", candidate, "--device", "llvmpipe", "--waivers", "w.json"});
  };
  const CommandResult waived = with("wrong.png", "llvmpipe", "9999-12-31", "wrong.png");
  CHECK(waived.exit_code == 0);
  CHECK(waived.out.find("waived until 9999-12-31: known") != std::string::npos);
  CHECK(with("wrong.png", "llvmpipe", "2020-01-31", "wrong.png").err.find("expired on 2020-01-31") != std::string::npos);
  CHECK(with("wrong.png", "llvmpipe", "9999-12-31", "golden.png").exit_code == 2);
  CHECK(with("wrong.png", "d3d11", "9999-12-31", "golden.png").exit_code == 0);  // another device's is not asked
  CHECK(with("wrong.png", "d3d11", "9999-12-31", "wrong.png").exit_code == 2);
  // One that covers nothing is seen also by who reads the documents only.
  folder.file(
      "w.json",
      R"({"schema":"etalon/waivers/1","waivers":[{"pair":"gone.png","device":"llvmpipe","reason":"<r>","expires":"9999-12-31","texels":1}]})");
  const json document =
      diff_document(folder, {"golden.exr", "golden.png", "--device", "llvmpipe", "--waivers", "w.json", "--junit", "w.xml"}, 2);
  CHECK(document["verdict"] == "failure");
  CHECK(document["jobs"][0]["verdict"] == "pass");
  const std::string junit = read_text(folder.path() / "w.xml");
  CHECK(junit.find("tests=\"2\" failures=\"1\"") != std::string::npos);
  CHECK(junit.find("<failure message=\"waiver of gone.png: covers nothing") != std::string::npos);
  // A waiver proves no tie.
  write_candidate(folder, "tie.png", [](Image& image) {
    image.channels<std::uint8_t>(32, 32)[0] ^= 0x40;
    image.channels<std::uint8_t>(1, 1)[0] ^= 1;
  });
  folder.file(
      "w.json",
      R"({"schema":"etalon/waivers/1","waivers":[{"pair":"tie.png","device":"llvmpipe","reason":"r","expires":"9999-12-31","texels":1}]})");
  std::filesystem::copy_file(folder.path() / "golden.png", folder.path() / "alone.png");
  CHECK(diff(folder, {"alone.png", "tie.png", "--device", "llvmpipe", "--waivers", "w.json"}).exit_code == 1);
  const auto refused = [&](const std::string& text, const std::string& mentions) {
    folder.file("w.json", text);
    check_refused({"diff", "golden.exr", "golden.png", "--device", "d3d11", "--waivers", "w.json"}, 4, folder, mentions);
  };
  const std::string good = R"({"pair":"a","device":"d3d11","reason":"r","expires":"2027-02-28","texels":1})";
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return R"({"schema":"etalon/waivers/1","waivers":[)" + text + "]}";
  };
  refused("hello", "etalon/waivers/1");
  refused(R"({"schema":"etalon/waivers/1"})", "waivers: expected an array");
  refused(R"({"schema":"etalon/waivers/1","waivers":[1]})", "waivers[0]: expected an object");
  refused(changed("\"r\"", "\"\""), "waivers[0].reason: expected a text");
  refused(changed("02-28", "02-30"), "waivers[0].expires: expected a day");
  refused(changed(":1}", ":0}"), "waivers[0].texels: expected the number");
  refused(changed("\"pair\"", "\"job\""), "got a member 'job'");
}

TEST_CASE("diff: what the command line cannot mean") {
  const ScratchFolder folder;
  write_grey(folder.path() / "a.png", 100);
  check_refused({"diff", "a.png"}, 64, folder, "candidate");
  check_refused({"diff", "a.png", "a.png", "--device", "glide"}, 64, folder, "--device: expected contract");
  check_refused({"diff", "a.png", "a.png", "--device", "vulkan:3"}, 64, folder, "vulkan:BITS");
  for (const char* device : {"vulkan:x", "vulkan:8:", "vulkan:8:3", "vulkan:8:25", "vulkan::8"})
    check_refused({"diff", "a.png", "a.png", "--device", device}, 64, folder, "vulkan:BITS");
  check_refused({"diff", "a.png", "a.png", "--draws", "a.draws"}, 64, folder, "--draws needs --device");
  check_refused({"diff", "a.png", "a.png", "--waivers", "w.json"}, 64, folder, "--waivers needs --device");
  check_refused({"diff", "a.png", "a.png", "-od"}, 64, folder, "--od needs -o");
  check_refused({"diff", "a.png", "a.png", "--texel", "1"}, 64, folder, "--texel: expected X,Y");
  check_refused({"diff", "a.png", "a.png", "--fail", "-1"}, 64, folder, "fail");
  check_refused({"diff", "a.png", "a.png", "--allowfailures", "-1"}, 64, folder, "allowfailures");
  for (const char* option : {"-o", "--html", "--junit"})
    check_refused({"diff", "a.png", "a.png", option, "-"}, 64, folder, "only --json writes to standard output");
  check_refused({"diff", "a.png", "a.png", "-o", "a.png"}, 64, folder, "a.png");
  check_refused({"diff", "a.png", "a.png", "--texel", "9,9"}, 4, folder, "texel (9, 9) is outside");
  check_refused({"diff", "a.png", "none.png"}, 4, folder, "none.png");
  check_refused({"diff", "a.png", "a.png", "--html", "none/h.html"}, 4, folder, "none");
}
