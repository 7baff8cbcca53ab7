// Every JSON document against its schema, and the promise that only `run` may differ between runs.
#include <cstdlib>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/run_command.h"
#include "tests/cli/schema_validator.h"

using namespace etalon::test;
using nlohmann::json;

namespace {

json checked_document(const std::vector<std::string>& arguments, const std::string& schema_name, const ScratchFolder& folder,
                      int exit_code = 0) {
  std::vector<std::string> with_json = arguments;
  with_json.insert(with_json.end(), {"--json", "-"});
  const CommandResult result = run_etalon(with_json, {.folder = folder.path()});
  CAPTURE(result.err);
  REQUIRE(result.exit_code == exit_code);
  const json document = json::parse(result.out);
  const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/" + schema_name));
  for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
  return document;
}

}  // namespace

TEST_CASE("make: models with vertex colours") {
  const ScratchFolder folder;
  const json duck = checked_document({"make", "duck", "--faces", "3000", "--open", "-o", "duck.ply"}, "make.json", folder);
  CHECK(duck["model"] == "duck");
  CHECK(!duck.contains("texture"));
  CHECK(std::abs(duck["faces"].get<int>() - 3000) < 100);
  const json knot = checked_document({"make", "knot", "--faces", "1000", "-o", "knot.ply"}, "make.json", folder);
  CHECK(knot["faces"] == 1000);
  CHECK(checked_document({"info", "knot.ply"}, "info.json", folder)["mesh"]["faces"] == 1000);
}

TEST_CASE("make: terrain is two images of one extent, and refuses what is not its own") {
  const ScratchFolder folder;
  const json made = checked_document({"make", "terrain", "--size", "33", "--texture-size", "64", "-o", "alps.tif"}, "make.json", folder);
  CHECK(folder.listing() == std::vector<std::string>{"alps.tif", "alps_color.png"});
  CHECK(made["vertices"] == 33 * 33);
  CHECK(made["faces"] == 2 * 32 * 32);
  CHECK(made["spacing_m"] == 160);
  const json dem = checked_document({"info", "alps.tif"}, "info.json", folder);
  CHECK(dem["image"]["sha256"] == made["dem"]["sha256"]);
  CHECK(checked_document({"info", "alps_color.png"}, "info.json", folder)["image"]["sha256"] == made["texture"]["sha256"]);
  const auto refusal = [&](std::vector<std::string> arguments) {
    const CommandResult result = run_etalon(arguments, {.folder = folder.path()});
    CHECK(result.exit_code == 64);
    return result.err;
  };
  CHECK(refusal({"make", "terrain", "--size", "100", "-o", "a.tif"}).find("expected 2^k+1 heights on a side") != std::string::npos);
  CHECK(refusal({"make", "terrain", "-o", "a.png"}).find("expected -o FILE.tif or .exr, got a.png") != std::string::npos);
  CHECK(refusal({"make", "terrain", "--faces", "100", "-o", "a.tif"}).find("terrain has --size heights") != std::string::npos);
  CHECK(refusal({"make", "terrain", "--open", "-o", "a.tif"}).find("--open is of duck") != std::string::npos);
  CHECK(refusal({"make", "knot", "--size", "33", "-o", "a.ply"}).find("--size is of terrain") != std::string::npos);
}

TEST_CASE("make, info, render: documents match their schemas") {
  const ScratchFolder folder;
  const json made = checked_document({"make", "swirl", "--faces", "200", "--texture-size", "64", "-o", "swirl.obj"}, "make.json", folder);
  CHECK(made["faces"] == 200);
  CHECK(folder.listing() == std::vector<std::string>{"swirl.mtl", "swirl.obj", "swirl_texture.png"});

  const json mesh = checked_document({"info", "swirl.obj"}, "info.json", folder);
  CHECK(mesh["kind"] == "mesh");
  CHECK(mesh["mesh"]["faces"] == 200);
  CHECK(mesh["materials"][0]["texture"]["sha256"] == made["texture"]["sha256"]);
  const json image = checked_document({"info", "swirl_texture.png"}, "info.json", folder);
  CHECK(image["image"]["width"] == 64);
  CHECK(image["image"]["sha256"] == made["texture"]["sha256"]);

  const json png = checked_document({"render", "swirl.obj", "--size", "40x30", "-o", "swirl_40.png"}, "render.json", folder);
  CHECK(png["width"] == 40);
  CHECK(png["height"] == 30);
  CHECK(png["targets"].size() == 1);
  const json exr = checked_document({"render", "swirl.obj", "--size", "32", "--margins", "-o", "swirl_32.exr"}, "render.json", folder);
  CHECK(exr["targets"].size() == 5);
  const json content = checked_document({"info", "swirl_32.exr"}, "info.json", folder);
  CHECK(content["kind"] == "exr");
  CHECK(content["attributes"]["drawListSha256"] == exr["draw_list_sha256"]);
  std::vector<std::string> channels;
  for (const json& channel : content["channels"]) channels.push_back(channel["name"]);
  CHECK(channels == std::vector<std::string>{"A", "B", "G", "R", "Z", "bound.uv", "bound.z", "id.triangle", "margin.edge", "margin.u",
                                             "margin.v", "margin.z"});
}

TEST_CASE("a model without texture coordinates has a document too") {
  const ScratchFolder folder;
  folder.file("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  CHECK(checked_document({"info", "plain.obj"}, "info.json", folder)["mesh"]["uv"].is_null());
}

TEST_CASE("verify: document, report and standard output say the same for 1, 2 and 7 threads") {
  const ScratchFolder folder;
  REQUIRE(run_etalon({"make", "swirl", "--faces", "512", "--texture-size", "64", "-o", "swirl.obj"}, {.folder = folder.path()}).exit_code ==
          0);
  std::string first;
  for (const char* threads : {"1", "2", "7"}) {
    const CommandResult result = run_etalon({"verify", "swirl.obj", "--size", "160x120", "--report", std::string("report") + threads,
                                             "--json", "verify.json", "--quiet", "--threads", threads},
                                            {.folder = folder.path()});
    REQUIRE((result.exit_code == 0 || result.exit_code == 1));  // 1: no OpenGL on this machine
    CHECK(result.out.empty());
    json document = json::parse(read_text(folder.path() / "verify.json"));
    const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/verify.json"));
    for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
    CHECK(document["run"]["threads"] == std::stoi(threads));
    json in_report = json::parse(read_text(folder.path() / (std::string("report") + threads) / "verify.json"));
    document.erase("run");
    in_report.erase("run");
    CHECK(in_report == document);
    if (first.empty()) first = document.dump();
    CHECK(document.dump() == first);
  }
}

TEST_CASE("the rendered bytes do not depend on threads, and '-' is standard output") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  const CommandResult one = run_etalon({"render", "square.obj", "--size", "64", "--threads", "1", "-o", "-"}, {.folder = folder.path()});
  CHECK(one.exit_code == 0);
  CHECK(one.out.substr(1, 3) == "PNG");
  CHECK(run_etalon({"render", "square.obj", "--size", "64", "--threads", "7", "-o", "-"}, {.folder = folder.path()}).out == one.out);
  CHECK(run_etalon({"render", "square.obj", "--size", "64", "-o", "square.png"}, {.folder = folder.path()}).exit_code == 0);
  CHECK(read_text(folder.path() / "square.png") == one.out);
}

TEST_CASE("peak_bytes is the program's own, however large the process that started it") {
  constexpr std::size_t kHeld = std::size_t{512} << 20;
  const ScratchFolder folder;
  const std::vector<char> held(kHeld, 1);
  const json document = checked_document({"make", "knot", "--faces", "1000", "-o", "knot.ply"}, "make.json", folder);
  REQUIRE(held[kHeld / 2] == 1);
  CHECK(document["run"]["peak_bytes"] > 1 << 20);
  CHECK(document["run"]["peak_bytes"] < kHeld / 2);
}
