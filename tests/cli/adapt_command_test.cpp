// etalon adapt: files, documents, exit codes.
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <utility>
#include <vector>

#include "tests/cli/run_command.h"
#include "tests/cli/schema_validator.h"
#include "tests/support/skip.h"

using namespace etalon::test;
using nlohmann::json;

namespace {

void make_swirl(const ScratchFolder& folder) {
  REQUIRE(
      run_etalon({"make", "swirl", "--faces", "1800", "--texture-size", "128", "-o", "swirl.obj"}, {.folder = folder.path()}).exit_code ==
      0);
  REQUIRE(run_etalon({"progressive", "swirl.obj", "--metric", "qem5", "--faces", "200", "-o", "swirl.epm"}, {.folder = folder.path()})
              .exit_code == 0);
}

// A wavy sheet of 2·n² triangles with texture coordinates (u, v) of (x, y) in [0, 1]².
template <class Coordinate>
std::string sheet_obj(int n, const Coordinate& coordinate) {
  std::string text;
  const auto add = [&](const std::string& line) { text += line + "\n"; };
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      const double s = static_cast<double>(x) / n, t = static_cast<double>(y) / n;
      const auto [u, v] = coordinate(s, t);
      add(fmt::format("v {} {} {}", s, t, 0.3 * s * (1 - s) * t));
      add(fmt::format("vt {} {}", u, v));
    }
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x + 1, b = a + 1, c = a + n + 1, d = c + 1;
      add(fmt::format("f {0}/{0} {1}/{1} {2}/{2}", a, b, d));
      add(fmt::format("f {0}/{0} {1}/{1} {2}/{2}", a, d, c));
    }
  return text;
}

// Its progressive mesh, sheet.epm: down to 60 faces, or to what its folds allow.
template <class Coordinate>
void make_sheet(const ScratchFolder& folder, const Coordinate& coordinate) {
  folder.file("sheet.obj", sheet_obj(12, coordinate));
  REQUIRE(run_etalon({"progressive", "sheet.obj", "--faces", "60", "-o", "sheet.epm"}, {.folder = folder.path()}).exit_code <= 1);
}

json run_adapt(const ScratchFolder& folder, std::vector<std::string> arguments, int exit_code) {
  arguments.insert(arguments.begin(), "adapt");
  arguments.insert(arguments.end(), {"--json", "-"});
  const CommandResult result = run_etalon(arguments, {.folder = folder.path()});
  CAPTURE(result.err);
  REQUIRE(result.exit_code == exit_code);
  json document = json::parse(result.out);
  for (const std::string& violation : schema_violations(json::parse(read_text(std::string(ETALON_SCHEMAS) + "/adapt.json")), document))
    FAIL_CHECK(violation);
  return document;
}

}  // namespace

TEST_CASE("adapt: a level with its texture and its map; the same bytes for 1 and 7 threads") {
  const ScratchFolder folder;
  make_swirl(folder);
  std::string texture, map;
  for (const char* threads : {"1", "7"}) {
    const CommandResult result = run_etalon({"adapt", "swirl.epm", "--faces", "300", "--texture", "swirl_texture.png", "-o", "level.obj",
                                             "--map", "level.exr", "--size", "256", "--threads", threads, "--json", "-"},
                                            {.folder = folder.path()});
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    const json document = json::parse(result.out);
    for (const std::string& violation : schema_violations(json::parse(read_text(std::string(ETALON_SCHEMAS) + "/adapt.json")), document))
      FAIL_CHECK(violation);
    CHECK(document["faces"] <= 300);
    CHECK(document["adaptations"] > 600);
    CHECK(document["packs"] < document["adaptations"]);
    CHECK(document["map_error_texels"]["median"] < 0.5);
    const std::string new_texture = read_text(folder.path() / "level_texture.png"), new_map = read_text(folder.path() / "level.exr");
    if (texture.empty()) texture = new_texture, map = new_map;
    CHECK(new_texture == texture);
    CHECK(new_map == map);
  }
  CHECK(texture != read_text(folder.path() / "swirl_texture.png"));
}

TEST_CASE("adapt: every format and filter of the map; one that cannot name the texels is a warning") {
  const ScratchFolder folder;
  make_swirl(folder);
  for (const std::string format : {"float32", "half", "unorm16", "unorm8"})
    for (const std::string filter : {"linear", "nearest"})
      for (const int size : {256, 512}) {
        CAPTURE(format);
        CAPTURE(filter);
        CAPTURE(size);
        const std::string map = format.starts_with("unorm") ? "map.png" : "map.exr";
        const CommandResult result = run_etalon({"adapt", "swirl.epm", "--faces", "300", "--map", map, "--size", std::to_string(size),
                                                 "--format", format, "--filter", filter, "--json", "-"},
                                                {.folder = folder.path()});
        CAPTURE(result.err);
        const json document = json::parse(result.out);
        CHECK(schema_violations(json::parse(read_text(std::string(ETALON_SCHEMAS) + "/adapt.json")), document).empty());
        const bool named = format != "unorm8" || size == 256;
        CHECK(result.exit_code == (named ? 0 : 1));
        CHECK((document["unnamed_texels"] == 0) == named);
        CHECK((result.err.find("cannot name") != std::string::npos) == !named);
        CHECK(document["format"] == format);
        // The steps of unorm8 are 1/255 of the map: lookups in between stay within a few of them.
        CHECK(document["map_error_texels"]["median"] < (format == "unorm8" ? 4 * size / 255.0 : 1.0));
      }
}

TEST_CASE("adapt: stored cells and cells made now give the same bytes; damaged ones are refused") {
  const ScratchFolder folder;
  make_swirl(folder);
  REQUIRE(run_etalon({"progressive", "swirl.obj", "--metric", "qem5", "--faces", "200", "--no-cells", "-o", "bare.epm"},
                     {.folder = folder.path()})
              .exit_code == 0);
  std::string map;
  for (const std::string file : {"swirl.epm", "bare.epm"}) {
    const CommandResult result =
        run_etalon({"adapt", file, "--faces", "300", "--map", "level.exr", "--size", "64"}, {.folder = folder.path()});
    CHECK(result.exit_code == 0);
    CHECK((result.out.find("has no cells") != std::string::npos) == (file == "bare.epm"));
    const std::string bytes = read_text(folder.path() / "level.exr");
    if (map.empty()) map = bytes;
    CHECK(bytes == map);
  }
  std::string damaged = read_text(folder.path() / "swirl.epm");
  damaged[damaged.find("CELL") + 30] ^= 1;
  folder.file("damaged.epm", damaged);
  check_refused({"adapt", "damaged.epm", "--faces", "300", "--map", "b.exr"}, 4, folder, "checksum");
}

TEST_CASE("adapt: several textures: adapted, through one map, or exact; each of its own size") {
  const ScratchFolder folder;
  make_swirl(folder);
  REQUIRE(
      run_etalon({"make", "swirl", "--faces", "1800", "--texture-size", "64", "-o", "small.obj"}, {.folder = folder.path()}).exit_code ==
      0);
  const std::vector<std::string> common = {"swirl.epm", "--faces",          "300", "--texture", "swirl_texture.png",
                                           "--texture", "small_texture.png"};
  std::vector<std::string> first, second;
  for (const auto& [way, name] :
       {std::pair<std::string, std::string>{"", "direct"}, {"--through-map", "through map"}, {"--analytic", "analytic"}}) {
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), {"-o", "level.obj"});
    if (!way.empty()) arguments.push_back(way);
    const json document = run_adapt(folder, arguments, 0);
    CHECK(document["way"] == name);
    CHECK(document["inputs"].size() == 3);
    CHECK(document["images"].size() == (way == "--through-map" ? 1 : 2));
    first.push_back(read_text(folder.path() / "level_texture.png")), second.push_back(read_text(folder.path() / "level_texture_2.png"));
    const json info = json::parse(run_etalon({"info", "level_texture_2.png", "--json", "-"}, {.folder = folder.path()}).out);
    CHECK(info.dump().find("64") != std::string::npos);
  }
  for (const std::vector<std::string>* textures : {&first, &second}) {
    CHECK((*textures)[0] != (*textures)[1]);
    CHECK((*textures)[0] != (*textures)[2]);
    CHECK((*textures)[1] != (*textures)[2]);
  }
  const json exact = run_adapt(folder, {"swirl.epm", "--faces", "300", "--map", "exact.exr", "--size", "300", "--analytic"}, 0);
  // float32: half of 2^-24 along either axis, of 300 texels.
  CHECK(exact["map_error_texels"]["max"] <= 300 * 0x1p-25 * 1.5);
  CHECK(exact["images"].size() == 1);
  CHECK(exact["images"][0]["adaptations"] > 0);
}

TEST_CASE("adapt: texture coordinates outside of [0, 1], folded and overlapping ones are said; tiled ones refused") {
  const ScratchFolder folder;
  make_sheet(folder, [](double s, double t) { return std::pair{s, t}; });
  const json plain = run_adapt(folder, {"sheet.epm", "--faces", "100", "--map", "map.exr", "--size", "64"}, 0);
  CHECK(plain["coordinates"]["outside"] == 0);
  CHECK(plain["coordinates"]["folds"] == 0);
  CHECK(plain["coordinates"]["overlap_share"] == 0);
  CHECK(plain["rings"]["made"] > 50);
  make_sheet(folder, [](double s, double t) { return std::pair{1.04 * s - 0.02, t}; });
  const json outside = run_adapt(folder, {"sheet.epm", "--faces", "100", "--map", "map.exr", "--size", "64"}, 0);
  CHECK(outside["coordinates"]["outside"] > 0);
  CHECK(outside["coordinates"]["outside_by"].get<double>() == doctest::Approx(0.02));
  // Half of the sheet turned over, onto the other half.
  make_sheet(folder, [](double s, double t) { return std::pair{s < 0.5 ? s : 0.9 - 0.8 * s, t}; });
  const json folded = run_adapt(folder, {"sheet.epm", "--faces", "100", "--map", "map.exr", "--size", "64"}, 1);
  CHECK(folded["coordinates"]["folds"] > 100);
  CHECK(folded["coordinates"]["overlap_share"] > 0.5);
  CHECK(folded["rings"]["fold"] > 0);
  std::filesystem::remove(folder.path() / "map.exr");
  make_sheet(folder, [](double s, double t) { return std::pair{3 * s, t}; });
  check_refused({"adapt", "sheet.epm", "--faces", "100", "--map", "map.exr"}, 4, folder, "tiled");
  make_sheet(folder, [](double s, double t) { return std::pair{1.4 * s, t}; });
  check_refused({"adapt", "sheet.epm", "--faces", "100", "--map", "map.exr", "--size", "8192"}, 4, folder, "2,048 texels outside");
}

TEST_CASE("adapt: --psnr says that the adapted texture shows the model better; at the finest level nothing differs") {
  const ScratchFolder folder;
  make_swirl(folder);
  const std::vector<std::string> common = {"swirl.epm", "--texture", "swirl_texture.png", "-o", "level.obj", "--psnr", "--faces"};
  std::vector<std::string> coarse = common, finest = common;
  coarse.emplace_back("300"), finest.emplace_back("100000");
  const json document = run_adapt(folder, coarse, 0);
  CHECK(document["psnr_db"]["adapted"].get<double>() > document["psnr_db"]["unadapted"].get<double>() + 1);
  CHECK(document["psnr_db"]["views"] == 24);
  const json same = run_adapt(folder, finest, 0);
  CHECK(same["psnr_db"]["adapted"].is_null());
  CHECK(same["psnr_db"]["unadapted"].is_null());
}

TEST_CASE("adapt: --backend gl, --shader exact gives the exact renderer's bytes; native ones are close") {
  const ScratchFolder folder;
  make_swirl(folder);
  const CommandResult exact =
      run_etalon({"adapt", "swirl.epm", "--faces", "300", "--map", "gl.exr", "--size", "64", "--backend", "gl", "--shader", "exact"},
                 {.folder = folder.path()});
  if (exact.exit_code == 4 && exact.err.find("GL: not available") != std::string::npos) return report_skip("adapt --backend gl", exact.err);
  REQUIRE(exact.exit_code == 0);
  const json cpu = run_adapt(folder, {"swirl.epm", "--faces", "300", "--map", "cpu.exr", "--size", "64"}, 0);
  CHECK(cpu["backend"] == "cpu");
  CHECK(read_text(folder.path() / "cpu.exr") == read_text(folder.path() / "gl.exr"));
  const json native = run_adapt(folder, {"swirl.epm", "--faces", "300", "--map", "gl.exr", "--size", "64", "--backend", "gl"}, 0);
  CHECK(native["backend"] == "gl");
  CHECK(native["run"]["device"].get<std::string>().find("llvmpipe") != std::string::npos);
  CHECK(native["map_error_texels"]["median"].get<double>() < cpu["map_error_texels"]["median"].get<double>() + 0.01);
  CHECK(native["images"][0]["texels_written"].is_null());
}

TEST_CASE("adapt: --backend gl where there is no OpenGL is refused in words") {
  const ScratchFolder folder;
  make_swirl(folder);
  const CommandResult result =
      run_etalon({"adapt", "swirl.epm", "--faces", "300", "--map", "gl.exr", "--backend", "gl"},
                 {.folder = folder.path(), .environment = {"MESA_GL_VERSION_OVERRIDE=2.1", "MESA_GLSL_VERSION_OVERRIDE=120"}});
  CHECK(result.exit_code == 1);
  CHECK(result.err.find("GL: not available (") != std::string::npos);
  CHECK(!std::filesystem::exists(folder.path() / "gl.exr"));
}

TEST_CASE("progressive: --flip-v turns texture coordinates over, so that the texture is adapted as of a model that was right") {
  const ScratchFolder folder;
  const auto right = [](double s, double t) { return std::pair{s, t}; };
  folder.file("sheet.obj", sheet_obj(8, right));
  folder.file("turned.obj", sheet_obj(8, [](double s, double t) { return std::pair{s, 1 - t}; }));
  const auto make = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "progressive");
    const CommandResult result = run_etalon(arguments, {.folder = folder.path()});
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
  };
  make({"sheet.obj", "--faces", "60", "-o", "right.epm"});
  make({"turned.obj", "--faces", "60", "-o", "as_it_is.epm"});
  make({"turned.obj", "--faces", "60", "--flip-v", "-o", "flipped.epm"});
  // Eighths: 1 - v is exact.
  CHECK(read_text(folder.path() / "flipped.epm") == read_text(folder.path() / "right.epm"));
  CHECK(read_text(folder.path() / "as_it_is.epm") != read_text(folder.path() / "right.epm"));
  check_refused({"progressive", "right.epm", "--faces", "70", "--flip-v", "-o", "level.obj"}, 64, folder, "--flip-v is of making");
  folder.file("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  check_refused({"progressive", "bare.obj", "--flip-v", "-o", "bare.epm"}, 4, folder, "--flip-v needs texture coordinates");
}

TEST_CASE("adapt: where nothing can be adapted it is said") {
  const ScratchFolder folder;
  make_sheet(folder, [](double s, double) { return std::pair{s, 0.5}; });
  const CommandResult result =
      run_etalon({"adapt", "sheet.epm", "--faces", "200", "--map", "map.exr", "--size", "64"}, {.folder = folder.path()});
  CHECK(result.exit_code == 1);
  CHECK(result.err.find("nothing was adapted") != std::string::npos);
}

TEST_CASE("adapt: levels at both ends") {
  const ScratchFolder folder;
  make_sheet(folder, [](double s, double t) { return std::pair{s, t}; });
  const json finest = run_adapt(folder, {"sheet.epm", "--faces", "1000000", "--map", "map.exr", "--size", "64"}, 0);
  CHECK(finest["faces"] == 288);
  CHECK(finest["adaptations"] == 0);
  CHECK(finest["map_error_texels"]["max"] <= 64 * 0x1p-25 * 1.5);
  CHECK(run_adapt(folder, {"sheet.epm", "--faces", "0", "--map", "map.exr", "--size", "64"}, 1)["faces"] == 60);
}

TEST_CASE("adapt: what is refused leaves nothing behind") {
  const ScratchFolder folder;
  make_swirl(folder);
  check_refused({"adapt", "swirl.epm", "--faces", "300"}, 64, folder, "--map");
  check_refused({"adapt", "swirl.epm", "--faces", "300", "-o", "level.obj"}, 64, folder, "go together");
  check_refused({"adapt", "swirl.epm", "--faces", "300", "--map", "level.png"}, 64, folder, ".exr");
  check_refused({"adapt", "swirl.epm", "--faces", "300", "--map", "level.exr", "--format", "unorm16"}, 64, folder, ".png");
  check_refused({"adapt", "swirl.epm", "--faces", "300", "--map", "level.exr", "--format", "double"}, 64, folder, "--format");
  check_refused({"adapt", "swirl.epm", "--faces", "300", "--map", "level.exr", "--size", "0"}, 64, folder, "size");
  check_refused({"adapt", "swirl.epm", "--faces", "300", "--map", "level.exr", "--size", "1000000"}, 64, folder, "1000000");
  check_refused({"adapt", "swirl.epm", "--faces", "-1", "--map", "level.exr"}, 64, folder, "--faces");
  check_refused({"adapt", "swirl.epm", "--faces", "300", "--map", "level.exr", "--psnr"}, 64, folder, "--psnr");
  check_refused({"adapt", "swirl.epm", "--faces", "300", "--map", "level.exr", "--through-map"}, 64, folder, "--texture");
  check_refused({"adapt", "swirl.epm", "--faces", "300", "--texture", "swirl_texture.png", "-o", "l.obj", "--through-map", "--analytic"},
                64, folder, "both");
  REQUIRE(
      run_etalon({"adapt", "swirl.epm", "--faces", "300", "--map", "colour.exr", "--size", "32"}, {.folder = folder.path()}).exit_code ==
      0);
  check_refused({"adapt", "swirl.epm", "--faces", "300", "--texture", "colour.exr", "-o", "l.obj"}, 4, folder, "8 or 16 bits");
  check_refused({"adapt", "swirl.epm", "--faces", "300", "--texture", "swirl_texture.png", "-o", "swirl.obj"}, 64, folder,
                "swirl_texture.png");
  check_refused({"adapt", "swirl.obj", "--faces", "300", "--map", "level.exr"}, 4, folder, "swirl.obj");
  const std::string whole = read_text(folder.path() / "swirl.epm");
  folder.file("cut.epm", whole.substr(0, whole.size() * 3 / 4));
  check_refused({"adapt", "cut.epm", "--faces", "300", "--map", "level.exr"}, 4, folder, "whole");
  folder.file("cut_in_splits.epm", whole.substr(0, whole.find("CELL") - 40));
  check_refused({"adapt", "cut_in_splits.epm", "--faces", "300", "--map", "level.exr"}, 4, folder, "whole progressive mesh");
  folder.file("cut_in_cells.epm", whole.substr(0, whole.rfind("CELL") + 40));
  check_refused({"adapt", "cut_in_cells.epm", "--faces", "300", "--map", "level.exr"}, 4, folder, "splits but not all that follows (cells");
  REQUIRE(run_etalon({"make", "duck", "--faces", "2000", "-o", "duck.ply"}, {.folder = folder.path()}).exit_code == 0);
  REQUIRE(run_etalon({"progressive", "duck.ply", "--faces", "1000", "-o", "duck.epm"}, {.folder = folder.path()}).exit_code == 0);
  check_refused({"adapt", "duck.epm", "--faces", "1500", "--map", "level.exr"}, 4, folder, "texture coordinates");
}
