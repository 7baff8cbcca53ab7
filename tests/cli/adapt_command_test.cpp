// etalon adapt: files, documents, exit codes.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/run_command.h"
#include "tests/cli/schema_validator.h"

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
  check_refused({"adapt", "swirl.obj", "--faces", "300", "--map", "level.exr"}, 4, folder, "swirl.obj");
  const std::string whole = read_text(folder.path() / "swirl.epm");
  folder.file("cut.epm", whole.substr(0, whole.size() * 3 / 4));
  check_refused({"adapt", "cut.epm", "--faces", "300", "--map", "level.exr"}, 4, folder, "whole");
  REQUIRE(run_etalon({"make", "duck", "--faces", "2000", "-o", "duck.ply"}, {.folder = folder.path()}).exit_code == 0);
  REQUIRE(run_etalon({"progressive", "duck.ply", "--faces", "1000", "-o", "duck.epm"}, {.folder = folder.path()}).exit_code == 0);
  check_refused({"adapt", "duck.epm", "--faces", "1500", "--map", "level.exr"}, 4, folder, "texture coordinates");
}
