// etalon make range, and bake of range images: files, documents, refusals.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "core/io/image_file.h"
#include "tests/cli/run_command.h"
#include "tests/cli/schema_validator.h"

using namespace etalon::test;
using nlohmann::json;

namespace {

json run_json(const ScratchFolder& folder, std::vector<std::string> arguments, int exit_code = 0) {
  const std::string schema_name = arguments[0] + ".json";
  arguments.insert(arguments.end(), {"--json", "-"});
  const CommandResult result = run_etalon(arguments, {.folder = folder.path()});
  CAPTURE(result.err);
  REQUIRE(result.exit_code == exit_code);
  json document = json::parse(result.out);
  const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/" + schema_name));
  for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
  return document;
}

}  // namespace

TEST_CASE("make range: a mesh, or depths with the colours beside them") {
  const ScratchFolder folder;
  const json mesh = run_json(folder, {"make", "range", "--kind", "soldier", "-o", "soldier.ply"});
  CHECK(mesh["model"] == "range");
  CHECK(mesh["range"]["kind"] == "soldier");
  CHECK(mesh["range"]["image"] == "chessboard");
  CHECK(mesh["range"]["spacing"] == 0.8125);
  const json info = run_json(folder, {"info", "soldier.ply"});
  CHECK(info["mesh"]["vertex_colors"] == true);
  CHECK(info["mesh"]["faces"] == mesh["faces"]);

  const json depths = run_json(folder, {"make", "range", "--kind", "soldier", "--image", "ramp", "-o", "d.exr"});
  CHECK(depths["range"]["image"] == "ramp");
  CHECK(depths["faces"] == mesh["faces"]);
  CHECK(run_json(folder, {"info", "d.exr"})["attributes"]["rangeSpacing"] == "0.8125");
  CHECK(run_json(folder, {"make", "range", "-o", "telephone.png"})["range"]["image"].is_null());
  CHECK(run_json(folder, {"info", "telephone.png"})["image"]["format"] == "r unorm16");
  CHECK(folder.listing() == std::vector<std::string>{"d.exr", "d_color.png", "soldier.ply", "telephone.png"});
}

TEST_CASE("bake: a range image in each format with its colours gives what the mesh of its samples gives") {
  const ScratchFolder folder;
  const std::vector<std::string> how = {"--tolerance", "2", "--size", "256"};
  const auto bake = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "bake");
    arguments.insert(arguments.end(), how.begin(), how.end());
    return run_json(folder, arguments);
  };
  const std::vector<std::string> kind = {"make", "range", "--kind", "soldier", "--image", "ramp", "-o"};
  for (const char* name : {"scan.ply", "d.png", "d.tif", "d.exr"}) {
    std::vector<std::string> arguments = kind;
    arguments.emplace_back(name);
    (void)run_json(folder, arguments);
  }
  const json mesh = bake({"scan.ply", "-o", "a.obj"});
  const json png = bake({"d.png", "--texture", "d_color.png", "--spacing", "0.8125", "--depth-scale", "0.00390625", "-o", "b.obj"});
  const json tiff = bake({"d.tif", "--texture", "d_color.png", "--spacing", "0.8125", "-o", "c.obj"});
  const json exr = bake({"d.exr", "--texture", "d_color.png", "-o", "e.obj"});
  for (const json& other : {png, tiff, exr}) {
    CHECK(other["vertices_in"] == mesh["vertices_in"]);
    CHECK(other["mesh_sha256"] == mesh["mesh_sha256"]);
    CHECK(other["texture_sha256"] == mesh["texture_sha256"]);
    CHECK(other["inputs"].size() == 2);
    CHECK(other["inputs"][1]["role"] == "texture");
  }
  // A smaller jump cuts more.
  CHECK(bake({"d.exr", "--texture", "d_color.png", "--max-jump", "0.5", "-o", "f.obj"})["faces_in"] < exr["faces_in"]);
}

TEST_CASE("make range and bake of range images: refusals, and nothing is written") {
  const ScratchFolder folder;
  check_refused({"make", "range", "--faces", "100", "-o", "a.ply"}, 64, folder, "--faces: range has as many triangles");
  check_refused({"make", "range", "--texture-size", "100", "-o", "a.ply"}, 64, folder, "range is coloured by vertex");
  check_refused({"make", "range", "--open", "-o", "a.ply"}, 64, folder, "--open is of duck");
  check_refused({"make", "range", "--kind", "cup", "-o", "a.ply"}, 64, folder, "cup");
  check_refused({"make", "range", "--image", "photo", "-o", "a.ply"}, 64, folder, "photo");
  check_refused({"make", "range", "-o", "-"}, 64, folder, "-o FILE");
  check_refused({"make", "range", "-o", "a.stl"}, 4, folder, "a.stl");
  check_refused({"make", "duck", "--kind", "hand", "-o", "a.ply"}, 64, folder, "--kind: of range only");
  check_refused({"make", "duck", "--image", "ramp", "-o", "a.ply"}, 64, folder, "--image: of range only");

  REQUIRE(run_etalon({"make", "range", "--image", "ramp", "-o", "d.png"}, {.folder = folder.path()}).exit_code == 0);
  REQUIRE(run_etalon({"make", "knot", "--faces", "1000", "-o", "knot.ply"}, {.folder = folder.path()}).exit_code == 0);
  REQUIRE(run_etalon({"make", "swirl", "--faces", "200", "--texture-size", "64", "-o", "s.obj"}, {.folder = folder.path()}).exit_code == 0);
  etalon::io::write_image(folder.path() / "line.tif", etalon::Image(4, 1, etalon::kR32f));
  const auto refused = [&](std::vector<std::string> arguments, int exit_code, const std::string& mentions) {
    arguments.insert(arguments.begin(), "bake");
    arguments.insert(arguments.end(), {"--faces", "400", "-o", "a.obj"});
    check_refused(arguments, exit_code, folder, mentions);
  };
  refused({"d.png", "--spacing", "1"}, 64, "expected --texture IMAGE");
  refused({"d.png", "--texture", "d_color.png"}, 4, "expected the spacing of its samples");
  refused({"d.png", "--texture", "s_texture.png", "--spacing", "1"}, 4, "s_texture.png: expected 256x256 as d.png has, got 64x64");
  refused({"d.png", "--texture", "missing.png", "--spacing", "1"}, 4, "missing.png");
  refused({"d_color.png", "--texture", "d_color.png", "--spacing", "1"}, 4, "expected one channel, got rgb unorm8");
  refused({"d.png", "--texture", "d_color.png", "--spacing", "0"}, 64, "--spacing");
  refused({"d.png", "--texture", "d_color.png", "--spacing", "nan"}, 64, "--spacing");
  refused({"d.png", "--texture", "d_color.png", "--spacing", "1", "--depth-scale", "0"}, 4, "depth scale");
  refused({"d.png", "--texture", "d_color.png", "--spacing", "1", "--max-jump", "-1"}, 64, "--max-jump");
  refused({"line.tif", "--texture", "line.tif", "--spacing", "1"}, 4, "line.tif: a range image: expected neighbours");
  refused({"knot.ply", "--spacing", "1"}, 64, "--spacing: is of range images");
  refused({"knot.ply", "--texture", "d_color.png"}, 64, "--texture: is of range images");
  refused({"knot.ply", "--no-data", "1"}, 64, "--no-data: is of range images");
  refused({"s.obj", "--max-jump", "1"}, 64, "--max-jump: is of range images and PLY range grids");
}
