// etalon joint: files, documents, exit codes.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <limits>
#include <string>
#include <vector>

#include "core/io/image_file.h"
#include "tests/cli/run_command.h"
#include "tests/cli/schema_validator.h"

using namespace etalon;
using namespace etalon::test;
using nlohmann::json;

namespace {

/// A valley, 40 × 33 samples 10 m apart; and stripes of the same shape, `scale` texels a sample.
Image small_dem() {
  Image dem(40, 33, kR32f);
  for (int y = 0; y < 33; ++y)
    for (int x = 0; x < 40; ++x)
      *dem.channels<float>(x, y) = 1000.0f + static_cast<float>((x - 20) * (x - 20)) / 4 + static_cast<float>((x * 7 + y * 13) % 11);
  return dem;
}
Image small_image(int width, int height) {
  Image image(width, height, kRgb8);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      auto* texel = image.channels<std::uint8_t>(x, y);
      texel[0] = static_cast<std::uint8_t>(x * 3), texel[1] = static_cast<std::uint8_t>((x / 5 + y / 7) % 2 * 120 + 60);
      texel[2] = static_cast<std::uint8_t>(y * x % 250);
    }
  return image;
}

ScratchFolder& small_terrain(ScratchFolder& folder) {
  io::write_image(folder.path() / "dem.tif", small_dem());
  io::write_image(folder.path() / "photo.png", small_image(80, 66));
  return folder;
}

CommandResult joint(const ScratchFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"joint"});
  arguments.insert(arguments.end(), {"--meshes", "8", "--textures", "6", "--size", "96x72"});
  return run_etalon(arguments, {.folder = folder.path()});
}

json document_of(const CommandResult& result) {
  CAPTURE(result.err);
  json document = json::parse(result.out);
  const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/joint.json"));
  for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
  return document;
}

}  // namespace

TEST_CASE("joint: files, the document, the same bytes for 1, 2 and 7 threads") {
  ScratchFolder folder;
  small_terrain(folder);
  std::string first;
  for (const char* threads : {"1", "2", "7"}) {
    const CommandResult result =
        joint(folder, {"dem.tif", "photo.png", "--search", "exhaustive", "-o", "both", "--json", "-", "--threads", threads});
    REQUIRE(result.exit_code == 0);
    json document = document_of(result);
    CHECK(document["grid"] == 33);
    CHECK(document["texture_size"] == 66);
    CHECK(document["gap_db"]["max"].get<double>() >= document["gap_db"]["mean"].get<double>());
    const json& path = document["path"];
    CHECK(path.front()["mesh"] == 0);
    CHECK(path.back()["bits"].get<int>() == 8 * document["bytes"].get<int>());
    CHECK(document["chosen"] == path.back());
    CHECK(document["evaluations"].get<int>() <= 2 * (8 + 6));
    CHECK(read_text(folder.path() / "both/joint.ejt").size() == document["bytes"]);
    document.erase("run");
    std::string all = document.dump();
    for (const char* file : {"joint.ejt", "path.csv", "pairs.csv", "model.obj", "model_texture.png", "picture.png", "full.png"})
      all += read_text(folder.path() / "both" / file);
    if (first.empty()) first = all;
    CHECK(all == first);
  }
}

TEST_CASE("joint: a budget chooses the model; one below the smallest pair is refused, one above the largest is said") {
  ScratchFolder folder;
  small_terrain(folder);
  const json whole = document_of(joint(folder, {"dem.tif", "photo.png", "-o", "whole", "--json", "-"}));
  const json& path = whole["path"];
  const std::size_t middle = path.size() / 2;
  const int bytes = path[middle]["bits"].get<int>() / 8;
  const json part = document_of(joint(folder, {"dem.tif", "photo.png", "-o", "part", "--budget", std::to_string(bytes), "--json", "-"}));
  CHECK(part["chosen"] == path[middle]);
  const json less =
      document_of(joint(folder, {"dem.tif", "photo.png", "-o", "less", "--budget", std::to_string(bytes - 1), "--json", "-"}));
  CHECK(less["chosen"] == path[middle - 1]);
  CHECK(read_text(folder.path() / "part/joint.ejt") == read_text(folder.path() / "whole/joint.ejt"));

  const CommandResult small = joint(folder, {"dem.tif", "photo.png", "-o", "small", "--budget", "10"});
  CHECK(small.exit_code == 4);
  CHECK(small.err.find("--budget: expected at least the " + std::to_string(path.front()["bits"].get<int>() / 8) + " bytes") !=
        std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "small"));
  const CommandResult large = joint(folder, {"dem.tif", "photo.png", "-o", "large", "--budget", "10000000"});
  CHECK(large.exit_code == 0);
  CHECK(large.out.find("of the budget's 10,000,000") != std::string::npos);
}

TEST_CASE("joint: a stream, and a beginning of it, is opened as the model that was chosen") {
  ScratchFolder folder;
  small_terrain(folder);
  const json whole = document_of(joint(folder, {"dem.tif", "photo.png", "-o", "whole", "--json", "-"}));
  const std::string stream = read_text(folder.path() / "whole/joint.ejt");
  const CommandResult opened = run_etalon({"joint", "whole/joint.ejt", "-o", "opened"}, {.folder = folder.path()});
  CHECK(opened.exit_code == 0);
  CHECK(opened.out.find("prefix") == std::string::npos);
  for (const char* file : {"model.obj", "model_texture.png", "picture.png"})
    CHECK(read_text(folder.path() / "opened" / file) == read_text(folder.path() / "whole" / file));

  const std::size_t middle = whole["path"].size() / 2, bytes = whole["path"][middle]["bits"].get<std::size_t>() / 8;
  (void)document_of(joint(folder, {"dem.tif", "photo.png", "-o", "part", "--budget", std::to_string(bytes), "--json", "-"}));
  (void)folder.file("begin.ejt", stream.substr(0, bytes + 3));
  const CommandResult part = run_etalon({"joint", "begin.ejt", "-o", "opened2"}, {.folder = folder.path()});
  CHECK(part.exit_code == 0);
  CHECK(part.out.find("note: a prefix") != std::string::npos);
  for (const char* file : {"model.obj", "model_texture.png", "picture.png"})
    CHECK(read_text(folder.path() / "opened2" / file) == read_text(folder.path() / "part" / file));

  (void)folder.file("short.ejt", stream.substr(0, 40));
  const CommandResult refused = run_etalon({"joint", "short.ejt", "-o", "none"}, {.folder = folder.path()});
  CHECK(refused.exit_code == 4);
  CHECK(refused.err.find("short.ejt: joint stream: byte") != std::string::npos);
  CHECK(run_etalon({"joint", "dem.tif", "-o", "none"}, {.folder = folder.path()}).exit_code == 64);
  for (const auto& [name, value] :
       {std::pair{"--json", "-"}, {"--budget", "400"}, {"--size", "40x30"}, {"--view", "fit"}, {"--grid", "33"}}) {
    const CommandResult choice = run_etalon({"joint", "whole/joint.ejt", "-o", "none", name, value}, {.folder = folder.path()});
    CHECK(choice.exit_code == 64);
    CHECK(choice.err.find(std::string(name) + " belongs to DEM IMAGE") != std::string::npos);
  }
  CHECK(run_etalon({"joint", "whole/joint.ejt", "-o", "threads", "--threads", "2", "--quiet"}, {.folder = folder.path()}).exit_code == 0);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "none"));
}

TEST_CASE("joint: rules, directions, kernels, grids, view files") {
  ScratchFolder folder;
  small_terrain(folder);
  (void)folder.file("view.json",
                    R"({"schema": "etalon/view/1", "eye": [0, 1400, 250], "target": [0, 1000, 0], "up": [0, 1, 0],
                 "tan_half_fov_y": 0.4, "near": 1, "far": 5000})");
  const json grown = document_of(joint(folder, {"dem.tif", "photo.png", "--search", "grow", "-o", "a", "--json", "-"}));
  CHECK(grown["search"] == "grow");
  for (const char* rule : {"printed", "budget"})
    CHECK(document_of(joint(folder, {"dem.tif", "photo.png", "--rule", rule, "-o", "b", "--json", "-"}))["rule"] == rule);
  const json viewed = document_of(joint(folder, {"dem.tif", "photo.png", "--view", "view.json", "--kernel", "5/3", "--grid", "17",
                                                 "--texture-size", "32", "-o", "c", "--json", "-"}));
  CHECK(viewed["grid"] == 17);
  CHECK(viewed["texture_size"] == 32);
  CHECK(viewed["notes"].size() == 5);  // window, resampling, spacing, the image's window and resampling
}

TEST_CASE("joint --pyramid distance: a file whose textures are by distance opens as its model") {
  ScratchFolder folder;
  small_terrain(folder);
  const json whole = document_of(joint(folder, {"dem.tif", "photo.png", "--pyramid", "distance", "-o", "whole", "--json", "-"}));
  CHECK(whole["pyramid"] == "distance");
  CHECK(run_etalon({"joint", "whole/joint.ejt", "-o", "opened"}, {.folder = folder.path()}).exit_code == 0);
  for (const char* file : {"model.obj", "model_texture.png", "picture.png"})
    CHECK(read_text(folder.path() / "opened" / file) == read_text(folder.path() / "whole" / file));
  CHECK(document_of(joint(folder, {"dem.tif", "photo.png", "-o", "other", "--json", "-"}))["pyramid"] == "significance");
  check_refused({"joint", "dem.tif", "photo.png", "--pyramid", "distance", "--textures", "44", "-o", "none"}, 64, folder,
                "--pyramid distance: expected at most 43 --textures, got 44");
}

TEST_CASE("joint: inputs that do not fit are refused, doubtful ones warned of") {
  ScratchFolder folder;
  small_terrain(folder);
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& why) {
    const CommandResult result = joint(folder, arguments);
    CHECK(result.exit_code == 4);
    CAPTURE(result.err);
    CHECK(result.err.find(why) != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(folder.path() / "none"));
  };
  io::write_image(folder.path() / "square.png", small_image(64, 64));
  refused({"dem.tif", "square.png", "-o", "none"},
          "square.png: expected the extent of the DEM, whose 40x33 samples have another shape, got 64x64 texels");
  refused({"dem.tif", "missing.png", "-o", "none"}, "missing.png");
  refused({"photo.png", "photo.png", "-o", "none"}, "photo.png: ");
  refused({"dem.tif", "dem.tif", "-o", "none"}, "dem.tif: expected an image of 8 bits a channel");
  refused({"dem.tif", "photo.png", "--grid", "20", "-o", "none"}, "--grid: expected 2^k + 1 points");
  Image hole = small_dem();
  *hole.channels<float>(12, 9) = std::numeric_limits<float>::quiet_NaN();
  io::write_image(folder.path() / "hole.tif", hole);
  refused({"hole.tif", "photo.png", "-o", "none"}, "hole.tif: ");
  *hole.channels<float>(12, 9) = -9999;
  io::write_image(folder.path() / "nodata.tif", hole);
  refused({"nodata.tif", "photo.png", "-o", "none"}, "nodata.tif: ");
  (void)folder.file("away.json",
                    R"({"schema": "etalon/view/1", "eye": [0, 1400, 250], "target": [0, 2400, 900], "up": [0, 1, 0],
                 "tan_half_fov_y": 0.2, "near": 1, "far": 5000})");
  refused({"dem.tif", "photo.png", "--view", "away.json", "-o", "none"}, "nothing");

  Image bytes(40, 33, {ChannelType::unorm8, 1});
  for (int y = 0; y < 33; ++y)
    for (int x = 0; x < 40; ++x) *bytes.channels<std::uint8_t>(x, y) = static_cast<std::uint8_t>(x * 5 + y);
  io::write_image(folder.path() / "bytes.png", bytes);
  const CommandResult warned = joint(folder, {"bytes.png", "photo.png", "-o", "bytes", "--json", "-"});
  CHECK(warned.exit_code == 1);
  CHECK(warned.err.find("8 bits") != std::string::npos);
  CHECK(document_of(warned)["warnings"].size() == 1);
  Image steps(40, 33, {ChannelType::unorm16, 1});  // decimetres
  for (int y = 0; y < 33; ++y)
    for (int x = 0; x < 40; ++x) *steps.channels<std::uint16_t>(x, y) = static_cast<std::uint16_t>(12000 + 50 * x + 7 * y);
  io::write_image(folder.path() / "steps.png", steps);
  refused({"steps.png", "photo.png", "-o", "none"}, "a step of it is taken as 1 m (--height-scale)");
  CHECK(joint(folder, {"steps.png", "photo.png", "--height-scale", "0.1", "-o", "steps"}).exit_code == 0);
  CHECK(joint(folder, {"dem.tif", "photo.png", "-o", "-"}).exit_code == 64);
  CHECK(joint(folder, {"dem.tif", "photo.png", "-o", "none", "--search", "best"}).exit_code == 64);
}
