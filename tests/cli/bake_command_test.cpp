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

// A triangle whose first x and first red are as given.
std::string nan_triangle(const std::string& x, const std::string& red) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float red\n"
         "property float green\nproperty float blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" +
         x + " 0 0 " + red + " 0 0\n1 1 0 0 1 0\n0 1 0 0 0 1\n3 0 1 2\n";
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
  const json sampled = run_bake(folder, {"knot.ply", "--faces", "400", "--size", "128x120", "--fill", "sampled", "-o", "sampled.ply"}, 0);
  CHECK(sampled["fill"] == "sampled");
  CHECK(sampled["iterations"] == 0);
  CHECK(sampled["seam_residual_max"] == 0);
  CHECK(sampled["mesh_sha256"] == exact["mesh_sha256"]);
  CHECK(sampled["texture_sha256"] != exact["texture_sha256"]);
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

TEST_CASE("bake --gutter: its growth is said, and a GLB asks for the lookup that it is for") {
  const ScratchFolder folder;
  make_knot(folder);
  const std::vector<std::string> common{"knot.ply", "--faces", "300", "--size", "512"};
  const auto baked = [&](std::vector<std::string> more) {
    more.insert(more.begin(), common.begin(), common.end());
    return run_bake(folder, more, 0);
  };
  CHECK(baked({"-o", "none.glb"})["gutter"].is_null());
  const json level0 = baked({"--gutter", "0", "-o", "zero.glb"})["gutter"], level2 = baked({"--gutter", "2", "-o", "two.glb"})["gutter"];
  CHECK(holds(folder, "none.glb", "\"magFilter\":9728,\"minFilter\":9728"));
  CHECK(holds(folder, "zero.glb", "\"magFilter\":9729,\"minFilter\":9729"));
  CHECK(holds(folder, "two.glb", "\"magFilter\":9729,\"minFilter\":9987"));
  CHECK(level0["border"] == 1);
  CHECK(level2["levels"] == 2);
  CHECK(level2["border"] == 4);
  CHECK(level0["growth"] > 1);
  CHECK(level2["growth"] > level0["growth"]);
  CHECK(level2["growth"].get<double>() == level2["rows"].get<double>() / level2["rows_without"].get<double>());
  std::vector<std::string> told{"bake"};
  told.insert(told.end(), common.begin(), common.end());
  told.insert(told.end(), {"--gutter", "2", "-o", "two.obj"});
  const CommandResult result = run_etalon(told, {.folder = folder.path()});
  CHECK(result.exit_code == 0);
  CHECK(result.out.find("gutter of 4 texels for linear lookup in levels 0 to 2: triangles of these sizes take") != std::string::npos);
  CHECK(run_etalon({"render", "two.obj", "--filter", "linear", "--size", "64", "-o", "view.png"}, {.folder = folder.path()}).exit_code ==
        0);
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

TEST_CASE("bake: a single triangle, and triangles without area, are baked") {
  const ScratchFolder folder;
  folder.file("one.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
  const json one = run_bake(folder, {"one.obj", "--faces", "1", "--size", "2x3", "-o", "small.obj"}, 0);
  CHECK(one["faces_out"] == 1);
  CHECK(one["texels"]["inside"] == 3);
  CHECK(one["texels"]["hit"] == 3);
  folder.file("line.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 2 0 0 0 0 1\nv 0 1 0 1 1 1\nf 1 2 3\nf 1 3 4\n");
  const json line = run_bake(folder, {"line.obj", "--faces", "2", "--size", "32", "-o", "line.ply"}, 0);
  CHECK(line["faces_out"] == 2);
  CHECK(line["seam_residual_max"] == 0);
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
  refused({"knot.ply", "--faces", "400", "--size", "1", "-o", "a.obj"}, 64, "a texture map of 1x1");
  refused({"knot.ply", "--faces", "400", "--gutter", "9", "-o", "a.obj"}, 64, "gutter");
  refused({"knot.ply", "--faces", "400", "--gutter", "-1", "-o", "a.obj"}, 64, "gutter");
  refused({"knot.ply", "--faces", "400", "--gutter", "3", "--size", "64x68", "-o", "a.obj"}, 64, "a height that is a multiple of 8");
  refused({"knot.ply", "--faces", "400", "--gutter", "5", "--size", "32", "-o", "a.obj"}, 64, "expected at least 64x128");
  refused({"knot.ply", "--faces", "400", "--gutter", "3", "--size", "128", "-o", "a.obj"}, 4,
          "the smallest of this width is 128x800, the smallest square 512x512");
  folder.file("nan_place.ply", nan_triangle("nan", "255"));
  folder.file("nan_color.ply", nan_triangle("1", "nan"));
  folder.file("empty.ply",
              "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
              "property uchar green\nproperty uchar blue\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n");
  folder.file("point.obj", "v 0 0 0 1 0 0\nv 0 0 0 0 1 0\nv 0 0 0 0 0 1\nf 1 2 3\n");
  refused({"nan_place.ply", "--faces", "1", "-o", "a.obj"}, 4, "nan_place.ply");
  refused({"nan_color.ply", "--faces", "1", "-o", "a.obj"}, 4, "nan_color.ply");
  refused({"empty.ply", "--faces", "1", "-o", "a.obj"}, 4, "empty.ply");
  refused({"point.obj", "--faces", "1", "-o", "a.obj"}, 4, "point.obj");
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
