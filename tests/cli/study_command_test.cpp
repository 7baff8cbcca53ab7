// etalon study: files, documents, exit codes.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/io/image_file.h"
#include "tests/cli/run_command.h"
#include "tests/cli/schema_validator.h"

using namespace etalon::test;
using nlohmann::json;

namespace {

void make_knot(const ScratchFolder& folder) {
  REQUIRE(run_etalon({"make", "knot", "--faces", "2000", "-o", "knot.ply"}, {.folder = folder.path()}).exit_code == 0);
}

}  // namespace

TEST_CASE("study kim on a mesh of one's own: a folder, a document that keeps its schema, the same for 1 and 3 threads") {
  const ScratchFolder folder;
  make_knot(folder);
  json first;
  for (const char* threads : {"1", "3"}) {
    const CommandResult result =
        run_etalon({"study", "kim", "knot.ply", "--quick", "--reduction", "0.8", "--report", "out", "--threads", threads, "--json", "-"},
                   {.folder = folder.path()});
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    json document = json::parse(result.out);
    const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/study.json"));
    for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
    json in_folder = json::parse(read_text(folder.path() / "out" / "study.json"));
    in_folder.erase("run");
    CHECK(document["run"]["tables"].size() == 1);
    document.erase("run");
    CHECK(in_folder == document);
    if (first.is_null()) first = document;
    CHECK(first == document);
  }
  CHECK(first["inputs"][0]["name"] == "knot.ply");
  CHECK(first["tables"][0]["rows"][0][6] == 198);  // 20 % of 71 · 14 vertices
  for (const char* file : {"index.html", "table2.csv", "table3.csv", "unit-sweep.csv", "knot-kim.png", "legend.png"})
    CHECK(std::filesystem::exists(folder.path() / "out" / file));
  CHECK(read_text(folder.path() / "out" / "index.html").find("No figure of it counts") != std::string::npos);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "out"))
    CHECK(entry.path().filename().string().front() != '.');  // nothing temporary stays
}

TEST_CASE("study kim --quick on its own models takes seconds and sweeps the unit") {
  const ScratchFolder folder;
  const CommandResult result = run_etalon({"study", "kim", "duck", "--quick", "--report", "out"}, {.folder = folder.path()});
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(result.out.find("duck") != std::string::npos);
  CHECK(result.out.find("report: file://") != std::string::npos);
  const std::string page = read_text(folder.path() / "out" / "index.html");
  CHECK(page.find("id=\"sweep\"") != std::string::npos);
  CHECK(page.find("src=\"data:image/png;base64,") != std::string::npos);
}

TEST_CASE("study chen on a mesh of one's own: levels, texture, a document that keeps its schema") {
  const ScratchFolder folder;
  REQUIRE(run_etalon({"make", "swirl", "--faces", "800", "-o", "fox.obj"}, {.folder = folder.path()}).exit_code == 0);
  const CommandResult result =
      run_etalon({"study", "chen", "fox.obj", "--faces", "300", "--faces", "120", "--quick", "--report", "out", "--json", "-"},
                 {.folder = folder.path()});
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  json document = json::parse(result.out);
  const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/study.json"));
  for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
  CHECK(document["study"] == "chen");
  CHECK(document["inputs"][0]["name"] == "fox.obj");
  CHECK(document["tables"][0]["name"] == "psnr-masked");
  CHECK(document["tables"][0]["rows"].size() == 2);
  CHECK(document["tables"][0]["rows"][0][2] == 300);
  CHECK(document["claims"].size() == 9);
  CHECK(document["run"]["claims"].size() == 1);
  for (const char* file : {"index.html", "psnr-masked.csv", "table1-packs.csv", "table1-times.csv", "formats.csv", "fox-colour-300-map.png",
                           "plane-m0-adapted.png"})
    CHECK(std::filesystem::exists(folder.path() / "out" / file));
  const std::string notes = read_text(folder.path() / "out" / "study.md");
  CHECK(notes.find("](fox-colour-300-map.png)") != std::string::npos);
}

TEST_CASE("study chen --quick: the built-in models take seconds and show every figure that needs no other") {
  const ScratchFolder folder;
  const CommandResult result = run_etalon({"study", "chen", "--quick", "--report", "out"}, {.folder = folder.path()});
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(result.out.find("through the map") != std::string::npos);
  const std::string page = read_text(folder.path() / "out" / "index.html");
  for (int figure = 1; figure <= 9; ++figure) CHECK(page.find(fmt::format("Figure {}: ", figure)) != std::string::npos);
  CHECK(page.find("Figure 10: ") != std::string::npos);
  CHECK(page.find("Figure 15: ") != std::string::npos);
  CHECK(page.find("Several objects in one pass") != std::string::npos);
}

TEST_CASE("study horbelt --quick: the procedural alps, every figure, the same for 1 and 3 threads") {
  const ScratchFolder folder;
  std::string first;
  for (const char* threads : {"1", "3"}) {
    const CommandResult result =
        run_etalon({"study", "horbelt", "--quick", "--report", "out", "--threads", threads, "--json", "-"}, {.folder = folder.path()});
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    json document = json::parse(result.out);
    const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/study.json"));
    for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
    CHECK(document["study"] == "horbelt");
    CHECK(document["claims"].size() == 7);
    document.erase("run");
    if (first.empty()) first = document.dump();
    CHECK(document.dump() == first);
  }
  for (const char* file : {"figure4-alps-valley.svg", "figure5-alps-valley.svg", "alps-valley-pair-a.png", "alps-overview-mesh.png",
                           "alps-valley-distance-0.png", "alps-flight.png", "alps-flight-04.png", "flight.csv", "gaps.csv"})
    CHECK(std::filesystem::exists(folder.path() / "out" / file));
}

TEST_CASE("study soucy on a mesh of one's own: a document that keeps its schema, files, the same for 1 and 3 threads") {
  const ScratchFolder folder;
  make_knot(folder);
  json first;
  for (const char* threads : {"1", "3"}) {
    const CommandResult result =
        run_etalon({"study", "soucy", "knot.ply", "--faces", "300", "--quick", "--report", "out", "--threads", threads, "--json", "-"},
                   {.folder = folder.path()});
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    json document = json::parse(result.out);
    const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/study.json"));
    for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
    document.erase("run");
    if (first.is_null()) first = document;
    CHECK(first == document);
  }
  CHECK(first["study"] == "soucy");
  CHECK(first["inputs"][0]["name"] == "knot.ply");
  CHECK(first["claims"].size() == 3);
  CHECK(first["tables"][0]["name"] == "models");
  CHECK(first["tables"][0]["rows"][0][2] == 300);
  for (const char* file : {"index.html", "study.md", "models.csv", "bytes.csv", "knot-a.png", "knot-map.png", "fig1.svg", "fig6-8.svg"})
    CHECK(std::filesystem::exists(folder.path() / "out" / file));
}

TEST_CASE("study soucy --quick: a range image of the program's own, every figure") {
  const ScratchFolder folder;
  const CommandResult result = run_etalon({"study", "soucy", "telephone", "--quick", "--report", "out"}, {.folder = folder.path()});
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(result.out.find("note: A quick run") != std::string::npos);
  const std::string page = read_text(folder.path() / "out" / "index.html");
  for (const char* figure : {"Figure 1: ", "Figure 2: ", "Figure 3: ", "Figure 4: ", "Figure 5: ", "Figures 6 to 8: ",
                             "Figure 9: telephone", "Figure 10: telephone"})
    CHECK(page.find(figure) != std::string::npos);
  const json document = json::parse(read_text(folder.path() / "out" / "study.json"));
  CHECK(document["tables"][1]["name"] == "errors");
  CHECK(document["tables"][1]["rows"].size() == 8);  // two tolerances, two patterns, two maps
}

TEST_CASE("study soucy on a range image of one's own: patterns, and with its colours a model too") {
  const ScratchFolder folder;
  REQUIRE(run_etalon({"make", "range", "--kind", "soldier", "-o", "depth.exr"}, {.folder = folder.path()}).exit_code == 0);
  REQUIRE(run_etalon({"make", "range", "--kind", "soldier", "--image", "ramp", "-o", "mesh.ply"}, {.folder = folder.path()}).exit_code ==
          0);
  REQUIRE(run_etalon({"render", "mesh.ply", "--size", "256x256", "-o", "colour.png"}, {.folder = folder.path()}).exit_code == 0);
  const CommandResult result = run_etalon({"study", "soucy", "depth.exr", "--texture", "colour.png", "--tolerance", "2", "--tolerance",
                                           "2%", "--faces", "400", "--quick", "--report", "out", "--json", "-"},
                                          {.folder = folder.path()});
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const json document = json::parse(result.out);
  CHECK(document["claims"].size() == 8);
  CHECK(document["tables"][0]["name"] == "compression");
  CHECK(document["tables"][0]["rows"].size() == 2);
  CHECK(document["tables"][0]["rows"][0][3] == "2");
  CHECK(document["tables"][4]["name"] == "models");
  CHECK(document["tables"][4]["rows"][0][2] == 400);
  CHECK(std::filesystem::exists(folder.path() / "out" / "depth-1-chessboard-512.png"));
  const std::string notes = read_text(folder.path() / "out" / "study.md");
  CHECK(notes.find("etalon study soucy depth.exr --faces 400 --tolerance 2 --tolerance 2% --texture colour.png --quick") !=
        std::string::npos);
}

TEST_CASE("study: what is refused, and nothing is left behind") {
  const ScratchFolder folder;
  folder.file("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.file("taken", "a file where the folder should be");
  REQUIRE(run_etalon({"make", "range", "--kind", "telephone", "-o", "telephone.exr"}, {.folder = folder.path()}).exit_code == 0);
  check_refused({"study"}, 64, folder, "study");
  check_refused({"study", "kimm"}, 64, folder, "kimm");
  check_refused({"study", "kim", "plain.obj"}, 4, folder, "plain.obj: expected vertex colours, got none");
  check_refused({"study", "kim", "absent.ply"}, 4, folder, "absent.ply");
  check_refused({"study", "kim", "plain.obj", "--reduction", "1"}, 64, folder, "--reduction");
  check_refused({"study", "kim", "duck", "--quick", "--report", "taken"}, 4, folder, "taken");
  check_refused({"study", "kim", "plain.obj", "--json", "plain.obj"}, 64, folder, "plain.obj");
  check_refused({"study", "chen", "plain.obj"}, 4, folder, "plain.obj: expected texture coordinates, got none");
  check_refused({"study", "chen", "swirl", "spot", "--quick", "--data", "nowhere"}, 4, folder, "spot: expected spot/spot_triangulated.obj");
  check_refused({"study", "chen", "plain.obj", "--reduction", "0.5"}, 64, folder, "--reduction belongs to study kim");
  check_refused({"study", "kim", "plain.obj", "--faces", "5"}, 64, folder, "belong to study chen");
  check_refused({"study", "chen", "plain.obj", "--faces", "0"}, 64, folder, "--faces");
  check_refused({"study", "horbelt", "plain.obj"}, 64, folder, "expected an IMAGE after the DEM");
  check_refused({"study", "horbelt", "alps", "alps", "--quick"}, 64, folder, "two terrains of the name alps");
  check_refused({"study", "horbelt", "davosdorf", "--data", "nowhere"}, 4, folder, "davosdorf: expected davosdorf/davosdorf.tif");
  check_refused({"study", "horbelt", "--reduction", "0.5"}, 64, folder, "--reduction belongs to study kim");
  check_refused({"study", "chen", "--quick", "--report", "taken"}, 4, folder, "taken");
  check_refused({"study", "soucy", "plain.obj"}, 4, folder, "plain.obj: expected vertex colours, got none");
  check_refused({"study", "soucy", "absent.ply"}, 4, folder, "absent.ply");
  check_refused({"study", "soucy", "telephone.exr", "--tolerance", "2", "--tolerance", "1"}, 64, folder, "above the one before");
  etalon::Image line(4, 1, {etalon::ChannelType::unorm16, 1});  // samples without neighbours above or below: no triangle
  for (int x = 0; x < 4; ++x) *line.channels<std::uint16_t>(x, 0) = 7;
  etalon::io::write_image(folder.path() / "line.png", line);
  check_refused({"study", "soucy", "line.png", "--spacing", "1"}, 4, folder, "line.png: a range image");
  check_refused({"study", "soucy", "plain.obj", "--spacing", "2"}, 64, folder, "--spacing: is of range images");
  check_refused({"study", "kim", "duck", "--tolerance", "2"}, 64, folder, "belong to study soucy");
  check_refused({"study", "kim", "duck", "--texture", "a.png"}, 64, folder, "--texture belong to study chen and study soucy");
  check_refused({"study", "soucy", "duck", "--reduction", "0.5"}, 64, folder, "--reduction belongs to study kim");
  check_refused({"study", "soucy", "duck", "--faces", "5", "--faces", "6"}, 64, folder, "expected one --faces");
  check_refused({"study", "soucy", "duck", "--flip-v"}, 64, folder, "belongs to study chen");
}

TEST_CASE("study: an interrupt ends it with 130 and without a report") {
  const ScratchFolder folder;
  const CommandResult result =
      run_etalon({"study", "kim", "monkey", "--report", "out"}, {.folder = folder.path(), .interrupt_after_ms = 400});
  CHECK(result.exit_code == 130);
  CHECK(!std::filesystem::exists(folder.path() / "out" / "index.html"));
}

namespace {

/// A ridge of 36 × 36 samples, and a photo of twice as many texels.
void make_terrain_files(const ScratchFolder& folder) {
  etalon::Image dem(36, 36, etalon::kR32f), photo(72, 72, etalon::kRgb8);
  for (int y = 0; y < 36; ++y)
    for (int x = 0; x < 36; ++x)
      *dem.channels<float>(x, y) = 900.0f + static_cast<float>(200 - (x - 18) * (x - 18) / 2 + (x * 5 + y * 11) % 13);
  for (int y = 0; y < 72; ++y)
    for (int x = 0; x < 72; ++x) {
      auto* texel = photo.channels<std::uint8_t>(x, y);
      texel[0] = static_cast<std::uint8_t>(3 * x), texel[1] = static_cast<std::uint8_t>((x / 5 + y / 7) % 2 * 120 + 60);
      texel[2] = static_cast<std::uint8_t>(x * y % 250);
    }
  etalon::io::write_image(folder.path() / "dem.tif", dem);
  etalon::io::write_image(folder.path() / "photo.png", photo);
}

}  // namespace

TEST_CASE("study horbelt: the views that it writes are what joint --view and its own --view look from") {
  const ScratchFolder folder;
  make_terrain_files(folder);
  const auto text = [&](const char* file) { return read_text(folder.path() / file); };
  const CommandResult first =
      run_etalon({"study", "horbelt", "dem.tif", "photo.png", "--quick", "--report", "first", "--json", "-"}, {.folder = folder.path()});
  CAPTURE(first.err);
  REQUIRE(first.exit_code == 0);
  const json document = json::parse(first.out);
  const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/study.json"));
  for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
  CHECK(document["files"].size() == 3);  // two views, the sheet of the flight
  CHECK(document["files"][0]["file"] == "dem-valley-view.json");
  const json view = json::parse(text("first/dem-valley-view.json"));
  const json view_schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/view.json"));
  for (const std::string& violation : schema_violations(view_schema, view)) FAIL_CHECK(violation);
  CHECK(view["width"] == 160);
  CHECK(text("first/index.html").find("<a href=\"dem-valley-view.json\">") != std::string::npos);

  // The same picture of the full pair, and the same path: 12 meshes and 8 textures are those of --quick.
  const CommandResult joint = run_etalon({"joint", "dem.tif", "photo.png", "--view", "first/dem-valley-view.json", "--meshes", "12",
                                          "--textures", "8", "-o", "both", "--json", "-"},
                                         {.folder = folder.path()});
  CAPTURE(joint.err);
  REQUIRE(joint.exit_code == 0);
  CHECK(text("both/full.png") == text("first/dem-valley-full.png"));
  const json path = json::parse(joint.out)["path"];
  std::vector<json> studied;
  for (const json& table : document["tables"])
    for (const json& row : table["rows"])
      if (table["name"] == "paths" && row[1] == "valley") studied.push_back(row);
  REQUIRE(studied.size() == path.size());
  for (std::size_t n = 0; n < path.size(); ++n) {
    CHECK(studied[n][2] == path[n]["mesh"]);
    CHECK(studied[n][3] == path[n]["texture"]);
    CHECK(studied[n][4] == path[n]["bits"]);
  }

  const CommandResult second = run_etalon({"study", "horbelt", "dem.tif", "photo.png", "--quick", "--view", "first/dem-valley-view.json",
                                           "--view", "5/24", "--report", "second", "--json", "-"},
                                          {.folder = folder.path()});
  CAPTURE(second.err);
  REQUIRE(second.exit_code == 0);
  for (const char* file : {"dem-valley-view.json", "dem-valley-full.png", "figure4-dem-valley.svg", "figure5-dem-valley.svg"})
    CHECK(text((std::string("second/") + file).c_str()) == text((std::string("first/") + file).c_str()));
  CHECK(std::filesystem::exists(folder.path() / "second/dem-5-24-view.json"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "second/dem-overview-view.json"));
  CHECK(json::parse(second.out)["claims"].size() == 6);  // the share of the terrain that is visible is of the paper's view
}

TEST_CASE("study horbelt --view: what cannot be is refused") {
  const ScratchFolder folder;
  make_terrain_files(folder);
  const std::string down = R"({"schema": "etalon/view/1", "eye": [0, 2000, 1], "target": [0, 0, 0], "up": [0, 1, 0], "tan_half_fov_y": 0.3,
 "near": 1, "far": 9000})";
  (void)folder.file("down.json", down);
  (void)folder.file("down-view.json", down);
  std::filesystem::create_directory(folder.path() / "out");
  (void)folder.file("out/dem-down-view.json", down);
  (void)folder.file("away.json", R"({"schema": "etalon/view/1", "eye": [0, 2000, 0], "target": [0, 9000, 1], "up": [0, 1, 0],
 "tan_half_fov_y": 0.3, "near": 1, "far": 9000})");
  const auto refused = [&](std::vector<std::string> arguments, int exit_code, const char* mentions) {
    arguments.insert(arguments.begin(), {"study", "horbelt", "dem.tif", "photo.png", "--quick"});
    check_refused(arguments, exit_code, folder, mentions);
  };
  refused({"--view", "down.json", "--view", "down-view.json"}, 64, "two views of the name down: down.json and down-view.json");
  refused({"--view", "missing.json"}, 64, "--view: expected front");
  refused({"--view", "dem.tif"}, 4, "dem.tif");
  refused({"--view", "away.json"}, 4, "dem, away: ");
  refused({"--view", "out/dem-down-view.json", "--report", "out"}, 64, "would overwrite --view");
  check_refused({"study", "kim", "duck", "--view", "fit"}, 64, folder, "belong to study horbelt");
}

TEST_CASE("study horbelt on files of one's own: odd sizes, 8 and 16 bits, what is refused and what is said") {
  const ScratchFolder folder;
  etalon::Image bytes(41, 30, {etalon::ChannelType::unorm8, 1}), decimetres(41, 30, {etalon::ChannelType::unorm16, 1});
  etalon::Image photo(82, 60, {etalon::ChannelType::unorm8, 4});
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 41; ++x) {
      *bytes.channels<std::uint8_t>(x, y) = static_cast<std::uint8_t>(90 + (x - 20) * (x - 20) / 4 + y % 5);
      *decimetres.channels<std::uint16_t>(x, y) = static_cast<std::uint16_t>(11000 + 3 * (x - 20) * (x - 20) + 17 * (y % 5));
    }
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 82; ++x) {
      auto* texel = photo.channels<std::uint8_t>(x, y);
      texel[0] = static_cast<std::uint8_t>(3 * x), texel[1] = static_cast<std::uint8_t>((x / 6 + y / 4) % 2 * 90 + 80);
      texel[2] = static_cast<std::uint8_t>(4 * y), texel[3] = 128;
    }
  etalon::io::write_image(folder.path() / "bytes.png", bytes);
  etalon::io::write_image(folder.path() / "decimetres.png", decimetres);
  etalon::io::write_image(folder.path() / "photo.png", photo);
  const auto study = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"study", "horbelt"});
    arguments.insert(arguments.end(), {"--quick", "--report", "out"});
    return run_etalon(arguments, {.folder = folder.path()});
  };
  const CommandResult doubtful = study({"bytes.png", "photo.png", "--texture-size", "32", "--size", "96x64"});
  CHECK(doubtful.exit_code == 1);
  CHECK(doubtful.err.find("bytes.png: heights of 8 bits") != std::string::npos);
  const std::string page = read_text(folder.path() / "out/index.html");
  for (const char* said : {"Warning: bytes: heights of 8 bits", "of 41x30 heights, the 30x30 from column 5", "10 m apart (--spacing)",
                           "of 82x60 texels, the 60x60", "alpha is left out", "brought to 32x32", "17² heights, 32² texels"}) {
    CAPTURE(said);
    CHECK(page.find(said) != std::string::npos);
  }
  CHECK(page.find("davosdorf") == std::string::npos);

  const CommandResult scaled = study({"decimetres.png", "photo.png", "--height-scale", "0.1", "--spacing", "30", "--grid", "9"});
  CAPTURE(scaled.err);
  CHECK(scaled.exit_code == 0);
  CHECK(read_text(folder.path() / "out/study.md")
            .find("photo.png --grid 9 --spacing 30 --height-scale 0.1 --view decimetres-valley-view.json") != std::string::npos);
  const auto refused = [&](std::vector<std::string> arguments, int exit_code, const char* mentions) {
    arguments.insert(arguments.begin(), {"study", "horbelt"});
    check_refused(arguments, exit_code, folder, mentions);
  };
  refused({"decimetres.png", "photo.png"}, 4, "a step of it is taken as 1 m (--height-scale)");
  refused({"bytes.png", "bytes.png", "--grid", "20"}, 4, "--grid: expected 2^k + 1 points");
  refused({"alps", "--quick", "--grid", "33"}, 64, "belongs to a DEM and an IMAGE of one's own");
  refused({"--quick", "--spacing", "30"}, 64, "--spacing 30: belongs to a DEM");
  refused({"bytes.png", "photo.png", "--size", "0x4"}, 64, "--size");
  check_refused({"study", "kim", "duck", "--grid", "33"}, 64, folder, "belong to study horbelt");
  check_refused({"study", "kim", "duck", "--spacing", "3"}, 64, folder, "--spacing belongs to study soucy and study horbelt");
}

TEST_CASE("study all: each study in its folder, one index with every claim and its verdict") {
  const ScratchFolder folder;
  json first;
  for (const char* out : {"once", "again"}) {
    const CommandResult result = run_etalon({"study", "all", "--quick", "--report", out, "--json", "-"},
                                            {.folder = folder.path(), .environment = {"ETALON_DATA=/nonexistent"}});
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    json document = json::parse(result.out);
    const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/study.json"));
    for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
    CHECK(document["study"] == "all");
    std::size_t claims = 0;
    const std::filesystem::path report = folder.path() / out;
    const std::string page = read_text(report / "index.html");
    for (const std::string name : {"soucy", "chen", "kim", "horbelt"}) {
      CAPTURE(name);
      const json study = json::parse(read_text(report / name / "study.json"));
      claims += study["claims"].size();
      CHECK(page.find("href=\"" + name + "/index.html\"") != std::string::npos);
      CHECK(std::filesystem::exists(report / name / "index.html"));
      for (const json& table : study["tables"]) {
        const std::string csv = name + "/" + table["name"].get<std::string>() + ".csv";
        CAPTURE(csv);
        CHECK(page.find("href=\"" + csv + "\"") != std::string::npos);
        CHECK(std::filesystem::exists(report / csv));
      }
    }
    CHECK(claims > 20);
    CHECK(document["claims"].size() == claims);
    CHECK(document["pictures"].size() >= 4);
    CHECK(std::filesystem::exists(report / "all-claims.csv"));
    document.erase("run");
    if (first.is_null()) first = document;
    CHECK(first == document);
  }
  check_refused({"study", "all", "fox.obj"}, 64, folder, "models belong to one study");
}
