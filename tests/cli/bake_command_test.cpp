// etalon bake: files, documents, exit codes.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tests/cli/run_command.h"
#include "tests/cli/schema_validator.h"

using namespace etalon::test;
using nlohmann::json;

namespace {

void make_knot(const ScratchFolder& folder) {
  REQUIRE(run_etalon({"make", "knot", "--faces", "6000", "-o", "knot.ply"}, {.folder = folder.path()}).exit_code == 0);
}

json run_bake(const ScratchFolder& folder, std::vector<std::string> arguments, int exit_code) {
  arguments.insert(arguments.begin(), "bake");
  arguments.insert(arguments.end(), {"--json", "-"});
  const CommandResult result = run_etalon(arguments, {.folder = folder.path()});
  CAPTURE(result.err);
  REQUIRE(result.exit_code == exit_code);
  json document = json::parse(result.out);
  const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/bake.json"));
  for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
  return document;
}

bool holds(const ScratchFolder& folder, const std::string& file, const std::string& text) {
  return read_text(folder.path() / file).find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("bake: a model with its texture in each format, the document, the same bytes for 1, 2 and 7 threads") {
  const ScratchFolder folder;
  make_knot(folder);
  std::string first;
  for (const char* threads : {"1", "2", "7"}) {
    const json document = run_bake(folder, {"knot.ply", "--faces", "400", "--size", "128x120", "-o", "small.obj", "--threads", threads}, 0);
    CHECK(document["faces_out"] == 400);
    CHECK(document["stop"] == "faces");
    CHECK(document["width"] == 128);
    CHECK(document["height"] == 120);
    CHECK(document["seam_residual_max"] == 0);
    const json& texels = document["texels"];
    CHECK(texels["atlas"] == 128 * 120);
    CHECK(texels["hit"].get<int>() + texels["filled"].get<int>() == texels["inside"].get<int>());
    CHECK(texels["averaged"].get<int>() <= texels["hit"].get<int>());
    int triangles = 0;
    for (const json& size : document["sizes"]) triangles += size["triangles"].get<int>();
    CHECK(triangles == 400);
    json without_run = document;
    without_run.erase("run");
    const std::string all = without_run.dump() + read_text(folder.path() / "small.obj") + read_text(folder.path() / "small_texture.png");
    if (first.empty()) first = all;
    CHECK(all == first);
  }
  const json exact = run_bake(folder, {"knot.ply", "--faces", "400", "--size", "128x120", "--fill", "exact", "-o", "exact.ply"}, 0);
  CHECK(exact["iterations"] == 0);
  const CommandResult info = run_etalon({"info", "exact.ply", "--json", "-"}, {.folder = folder.path()});
  CHECK(json::parse(info.out)["materials"][0]["texture"]["width"] == 128);

  // Only a baked GLB asks viewers for nearest lookup.
  (void)run_bake(folder, {"knot.ply", "--tolerance", "1%", "--corners", "exact", "-o", "near.glb"}, 0);
  CHECK(holds(folder, "near.glb", "\"magFilter\":9728,\"minFilter\":9728"));
  CHECK(holds(folder, "near.glb", "\"sampler\":0"));
  REQUIRE(run_etalon({"make", "head", "--faces", "2000", "--texture-size", "64", "-o", "head.glb"}, {.folder = folder.path()}).exit_code ==
          0);
  CHECK_FALSE(holds(folder, "head.glb", "sampler"));
  for (const char* model : {"small.obj", "exact.ply", "near.glb"})
    CHECK(run_etalon({"render", model, "--filter", "nearest", "--size", "64", "-o", "view.png"}, {.folder = folder.path()}).exit_code == 0);
}

TEST_CASE("bake: a tolerance is kept; a count that cannot be reached is a warning") {
  const ScratchFolder folder;
  make_knot(folder);
  const json near = run_bake(folder, {"knot.ply", "--tolerance", "0.05", "-o", "near.obj"}, 0);
  CHECK(near["tolerance"] == 0.05);
  CHECK(near["distance_audited"] <= 0.05);
  CHECK(near["target_faces"].is_null());
  const json stuck = run_bake(folder, {"knot.ply", "--tolerance", "0.05", "--faces", "10", "-o", "stuck.obj"}, 1);
  CHECK(stuck["stop"] == "tolerance");
}

TEST_CASE("bake: what the scan has of no use or in disorder is said") {
  const ScratchFolder folder;
  // Three triangles on one edge, a loose vertex, and a triangle that names one twice.
  folder.file(
      "book.obj",
      "v 0 0 0 1 0 0\nv 0 0 1 0 1 0\nv 1 0 0 0 0 1\nv 0 1 0 1 1 0\nv -1 -1 0 1 1 1\nv 5 5 5 1 0 1\nf 1 2 3\nf 1 2 4\nf 2 1 5\nf 1 1 3\n");
  const json document = run_bake(folder, {"book.obj", "--faces", "3", "--size", "32", "-o", "small.obj"}, 0);
  CHECK(document["repair"]["non_manifold_edges"]["count"] == 1);
  CHECK(document["repair"]["repeated_corners"]["count"] == 1);
  CHECK(document["vertices_in_no_face"] == 1);
  CHECK(document["seam_residual_max"] == 0);
}

TEST_CASE("bake: refusals name what was expected, and nothing is written") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  folder.file("broken.ply", "ply\nformat ascii 1.0\n");
  make_knot(folder);
  const auto refused = [&](std::vector<std::string> arguments, int exit_code, const std::string& mentions) {
    arguments.insert(arguments.begin(), "bake");
    check_refused(arguments, exit_code, folder, mentions);
  };
  refused({"square.obj", "--faces", "2", "-o", "a.obj"}, 4, "square.obj: expected vertex colours, got none");
  refused({"knot.ply", "--faces", "400", "--size", "100", "-o", "a.obj"}, 64, "a width that is a power of two");
  refused({"knot.ply", "--faces", "400", "--size", "64x2", "-o", "a.obj"}, 64, "a height of 3");
  refused({"knot.ply", "--faces", "400", "--size", "32", "-o", "a.obj"}, 4,
          "the smallest of this width is 32x39, the smallest square 64x64");
  refused({"knot.ply", "--tolerance", "0", "-o", "a.obj"}, 64, "a length above 0");
  refused({"knot.ply", "--tolerance", "-1", "-o", "a.obj"}, 64, "a length");
  refused({"knot.ply", "--tolerance", "near", "-o", "a.obj"}, 64, "bake: --tolerance");
  refused({"knot.ply", "-o", "a.obj"}, 64, "expected --faces or --tolerance");
  refused({"knot.ply", "--faces", "0", "-o", "a.obj"}, 64, "faces");
  refused({"knot.ply", "--faces", "400", "--fill", "magic", "-o", "a.obj"}, 64, "magic");
  refused({"knot.ply", "--faces", "400", "--corners", "round", "-o", "a.obj"}, 64, "round");
  refused({"knot.ply", "--faces", "400", "-o", "-"}, 64, "-o FILE");
  refused({"knot.ply", "--faces", "400", "-o", "knot.ply"}, 64, "would overwrite the scan");
  refused({"knot.ply", "--faces", "400", "-o", "a.stl"}, 4, "a.stl");
  refused({"knot.ply", "--faces", "400", "-o", "nowhere/a.obj"}, 4, "nowhere");
  refused({"broken.ply", "--faces", "400", "-o", "a.obj"}, 4, "broken.ply");
  refused({"missing.ply", "--faces", "400", "-o", "a.obj"}, 4, "missing.ply");
}
