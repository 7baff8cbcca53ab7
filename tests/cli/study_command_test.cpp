// etalon study: files, documents, exit codes.
#include <algorithm>
#include <filesystem>

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
  for (const char* file :
       {"figure4-alps-valley.svg", "figure5-alps-valley.svg", "alps-valley-pair-a.png", "alps-overview-mesh.png", "gaps.csv"})
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
