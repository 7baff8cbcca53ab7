// etalon simplify, progressive and metro: files, documents, exit codes.
#include <algorithm>

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/run_command.h"
#include "tests/cli/schema_validator.h"

using namespace etalon::test;
using nlohmann::json;

namespace {

json checked_document(const CommandResult& result, const std::string& schema_name) {
  const json document = json::parse(result.out);
  const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/" + schema_name));
  for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
  return document;
}

/// Three triangles on one edge.
std::string book_obj() { return "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 -1 0\nf 1 2 3\nf 1 2 4\nf 2 1 5\n"; }

}  // namespace

TEST_CASE("simplify: a model and its texture, the document, the same bytes for 1, 2 and 7 threads") {
  const ScratchFolder folder;
  REQUIRE(run_etalon({"make", "head", "--faces", "2000", "--texture-size", "64", "-o", "head.obj"}, {.folder = folder.path()}).exit_code ==
          0);
  std::string first;
  for (const char* threads : {"1", "2", "7"}) {
    const CommandResult result = run_etalon(
        {"simplify", "head.obj", "--faces", "700", "-o", "small.obj", "--threads", threads, "--json", "-"}, {.folder = folder.path()});
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    const json document = checked_document(result, "simplify.json");
    CHECK(document["stop"] == "faces");
    CHECK(document["faces_out"] <= 700);
    CHECK(document["faces_out"] >= 699);
    const std::string written = read_text(folder.path() / "small.obj");
    if (first.empty()) first = written;
    CHECK(written == first);
  }
  CHECK(first.find("vt ") != std::string::npos);
  const std::vector<std::string> files = folder.listing();
  CHECK(std::find(files.begin(), files.end(), "small.mtl") != files.end());
  const CommandResult info = run_etalon({"info", "small.obj", "--json", "-"}, {.folder = folder.path()});
  CHECK(json::parse(info.out)["materials"][0]["texture"]["width"] == 64);
  CHECK(json::parse(info.out)["mesh"]["closed"] == true);
}

TEST_CASE("simplify: --ratio; a target that cannot be reached is a warning; non-manifold places are named or refused") {
  const ScratchFolder folder;
  REQUIRE(run_etalon({"make", "swirl", "--faces", "800", "--texture-size", "64", "-o", "swirl.obj"}, {.folder = folder.path()}).exit_code ==
          0);
  const CommandResult half =
      run_etalon({"simplify", "swirl.obj", "--ratio", "0.5", "-o", "half.ply", "--json", "-"}, {.folder = folder.path()});
  REQUIRE(half.exit_code == 0);
  CHECK(checked_document(half, "simplify.json")["target_faces"] == 400);
  const CommandResult none =
      run_etalon({"simplify", "swirl.obj", "--faces", "0", "-o", "none.ply", "--json", "-"}, {.folder = folder.path()});
  CHECK(none.exit_code == 1);
  CHECK(checked_document(none, "simplify.json")["stop"] == "exhausted");
  CHECK(none.err.find("every collapse left is refused") != std::string::npos);

  folder.file("book.obj", book_obj());
  const CommandResult book = run_etalon({"simplify", "book.obj", "--faces", "3", "-o", "book.ply"}, {.folder = folder.path()});
  CHECK(book.exit_code == 0);
  CHECK(book.out.find("edges of more than two faces: 1 (face 0): kept as they are") != std::string::npos);
  check_refused({"simplify", "book.obj", "--faces", "3", "--refuse-non-manifold", "-o", "b.ply"}, 4, folder,
                "book.obj: mesh: expected an oriented manifold, got 1 edges of more than two faces (first: face 0)");
}

TEST_CASE("simplify: --metric kim on vertex colours") {
  const ScratchFolder folder;
  std::string obj;
  for (int j = 0; j <= 8; ++j)
    for (int i = 0; i <= 8; ++i) obj += "v " + std::to_string(i) + " " + std::to_string(j) + " 0 " + (i < 4 ? "0 0 0\n" : "1 1 1\n");
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 8; ++i) {
      const int a = 9 * j + i + 1;
      obj += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(a + 10) + " " + std::to_string(a + 9) + "\n";
    }
  folder.file("board.obj", obj);
  const CommandResult kim =
      run_etalon({"simplify", "board.obj", "--faces", "20", "--metric", "kim", "--unit", "0.01", "-o", "kim.ply", "--json", "-"},
                 {.folder = folder.path()});
  REQUIRE(kim.exit_code == 0);
  const json document = checked_document(kim, "simplify.json");
  CHECK(document["metric"] == "kim");
  CHECK(document["error_state_bytes_per_vertex"] == 48);
  folder.file("square.obj", square_obj());
  check_refused({"simplify", "square.obj", "--faces", "1", "--metric", "kim", "-o", "a.ply"}, 4, folder,
                "square.obj: metric kim: expected vertex colours, got none");
  for (const std::string metric : {"qem5", "qem6", "hoppe"}) {
    CAPTURE(metric);
    const bool uv = metric == "qem5";
    const CommandResult ran = run_etalon({"simplify", uv ? "square.obj" : "board.obj", "--faces", uv ? "2" : "20", "--metric", metric,
                                          "--weight", "0.5", "-o", uv ? "m.obj" : "m.ply", "--json", "-"},
                                         {.folder = folder.path()});
    REQUIRE(ran.exit_code == 0);
    CHECK(checked_document(ran, "simplify.json")["metric"] == metric);
  }
  check_refused({"simplify", "square.obj", "--faces", "1", "--weight", "1", "-o", "a.ply"}, 64, folder, "--weight is of");
  check_refused({"simplify", "square.obj", "--faces", "1", "--unit", "1", "-o", "a.ply"}, 64, folder, "--unit is of --metric kim");
  check_refused({"simplify", "square.obj", "--faces", "1", "--metric", "kim", "--unit", "0", "-o", "a.ply"}, 64, folder, "unit");
  check_refused({"simplify", "square.obj", "--faces", "1", "--metric", "kim", "--unit", "1 mm", "-o", "a.ply"}, 64, folder,
                "--unit: expected a length of at least 0, as 0.01 or 0.5% of the diagonal, got 1 mm");
}

TEST_CASE("simplify: --collapse full and --tolerance") {
  const ScratchFolder folder;
  REQUIRE(run_etalon({"make", "swirl", "-o", "swirl.obj"}, {.folder = folder.path()}).exit_code == 0);
  const CommandResult full =
      run_etalon({"simplify", "swirl.obj", "--faces", "300", "--collapse", "full", "--metric", "qem5", "-o", "full.obj", "--json", "-"},
                 {.folder = folder.path()});
  REQUIRE(full.exit_code == 0);
  CHECK(checked_document(full, "simplify.json")["collapse"] == "full");
  for (const std::string collapse : {"half", "full"}) {
    const CommandResult near = run_etalon(
        {"simplify", "swirl.obj", "--tolerance", "1%", "--collapse", collapse, "-o", "near.obj", "--json", "-"}, {.folder = folder.path()});
    REQUIRE(near.exit_code == 0);
    const json document = checked_document(near, "simplify.json");
    CHECK(document["tolerance"].get<double>() > 0);
    CHECK(document["distance_audited"].get<double>() <= document["tolerance"].get<double>());
    CHECK(document["target_faces"] == 0);
  }
  const CommandResult aps =
      run_etalon({"simplify", "swirl.obj", "--ratio", "0.3", "--metric", "aps", "-o", "aps.obj", "--json", "-"}, {.folder = folder.path()});
  REQUIRE(aps.exit_code == 0);
  CHECK(checked_document(aps, "simplify.json")["metric"] == "aps");
  const CommandResult early =
      run_etalon({"simplify", "swirl.obj", "--faces", "2", "--tolerance", "0", "-o", "early.obj"}, {.folder = folder.path()});
  CHECK(early.exit_code == 1);
  check_refused({"simplify", "swirl.obj", "--tolerance", "-1", "-o", "a.obj"}, 64, folder, "--tolerance: expected a length");
  check_refused({"simplify", "swirl.obj", "--tolerance", "1%%", "-o", "a.obj"}, 64, folder, "--tolerance: expected a length");
  check_refused({"simplify", "swirl.obj", "--tolerance", "near", "-o", "a.obj"}, 64, folder, "--tolerance: expected a length");
  check_refused({"simplify", "swirl.obj", "--faces", "9", "--collapse", "full", "--metric", "kim", "-o", "a.obj"}, 64, folder,
                "--collapse half");
  check_refused({"simplify", "swirl.obj", "--faces", "9", "--collapse", "quarter", "-o", "a.obj"}, 64, folder, "quarter");
}

TEST_CASE("simplify: refusals") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  folder.file("broken.obj", "v 0 0 0\nf 1 2 3\n");
  check_refused({"simplify"}, 64, folder, "simplify:");
  check_refused({"simplify", "square.obj", "-o", "a.obj"}, 64, folder, "expected one of --faces, --ratio and --tolerance");
  check_refused({"simplify", "square.obj", "--faces", "1", "--ratio", "0.5", "-o", "a.obj"}, 64, folder,
                "expected one of --faces and --ratio, got both");
  check_refused({"simplify", "square.obj", "--faces", "1"}, 64, folder, "output");
  check_refused({"simplify", "square.obj", "--faces", "1", "-o", "-"}, 64, folder, "-o FILE");
  check_refused({"simplify", "square.obj", "--faces", "-1", "-o", "a.obj"}, 64, folder, "faces");
  check_refused({"simplify", "square.obj", "--ratio", "1.5", "-o", "a.obj"}, 64, folder, "ratio");
  check_refused({"simplify", "square.obj", "--ratio", "0.5", "--metric", "beauty", "-o", "a.obj"}, 64, folder, "beauty");
  check_refused({"simplify", "square.obj", "--ratio", "0.5", "--min-cosine", "2", "-o", "a.obj"}, 64, folder, "min-cosine");
  check_refused({"simplify", "square.obj", "--ratio", "0.5", "-o", "square.obj"}, 64, folder, "would overwrite the model");
  check_refused({"simplify", "square.obj", "--ratio", "0.5", "-o", "a.stl"}, 4, folder, "a.stl");
  check_refused({"simplify", "square.obj", "--ratio", "0.5", "-o", "nowhere/a.obj"}, 4, folder, "nowhere");
  check_refused({"simplify", "broken.obj", "--ratio", "0.5", "-o", "a.obj"}, 4, folder, "broken.obj");
  check_refused({"simplify", "missing.obj", "--ratio", "0.5", "-o", "a.obj"}, 4, folder, "missing.obj");
}

TEST_CASE("progressive: a level of the file is the simplified model; a cut file is a coarser one") {
  const ScratchFolder folder;
  REQUIRE(run_etalon({"make", "swirl", "--faces", "800", "--texture-size", "64", "-o", "swirl.obj"}, {.folder = folder.path()}).exit_code ==
          0);
  const CommandResult made = run_etalon({"progressive", "swirl.obj", "-o", "swirl.epm", "--json", "-"}, {.folder = folder.path()});
  REQUIRE(made.exit_code == 0);
  const json document = checked_document(made, "progressive.json");
  CHECK(document["faces"] == 800);
  CHECK(document["bytes"] == read_text(folder.path() / "swirl.epm").size());
  CHECK(document["cells"] > 8 * document["records"].get<int>());
  CHECK(document["folded_cells"] == 0);
  const json statistics = document["cell_statistics"];
  CHECK(statistics["rings"] > document["records"].get<int>() * 9 / 10);
  CHECK(statistics["file_bytes"]["per_split"] <= 60);
  CHECK(statistics["memory_bytes"]["per_split"] <= 200);
  const CommandResult level =
      run_etalon({"progressive", "swirl.epm", "--faces", "300", "-o", "level.ply", "--json", "-"}, {.folder = folder.path()});
  REQUIRE(level.exit_code == 0);
  CHECK(checked_document(level, "progressive.json")["faces"] <= 300);
  REQUIRE(run_etalon({"simplify", "swirl.obj", "--faces", "300", "-o", "direct.obj"}, {.folder = folder.path()}).exit_code == 0);
  const CommandResult distance =
      run_etalon({"metro", "level.ply", "direct.obj", "--samples", "1000", "--json", "-"}, {.folder = folder.path()});
  CHECK(json::parse(distance.out)["max"] < 1e-12);

  const CommandResult info = run_etalon({"info", "swirl.epm", "--json", "-"}, {.folder = folder.path()});
  const json found = checked_document(info, "info.json");
  CHECK(found["kind"] == "progressive");
  CHECK(found["progressive"]["complete"] == true);
  CHECK(found["progressive"]["faces"] == 800);
  CHECK(found["progressive"]["records"] == document["records"]);
  CHECK(found["progressive"]["cell_statistics"] == statistics);
  CHECK(info.out.find("damped_crossings") != std::string::npos);

  const CommandResult bare =
      run_etalon({"progressive", "swirl.obj", "--no-cells", "-o", "bare.epm", "--json", "-"}, {.folder = folder.path()});
  const json without = checked_document(bare, "progressive.json");
  CHECK(without["cells"].is_null());
  CHECK(without["bytes"].get<std::size_t>() + statistics["file_bytes"]["total"].get<std::size_t>() == document["bytes"]);
  CHECK(run_etalon({"info", "bare.epm"}, {.folder = folder.path()}).out.find("cells for texture adaptation: none") != std::string::npos);
  check_refused({"progressive", "swirl.epm", "--faces", "3", "--no-cells", "-o", "b.ply"}, 64, folder, "--no-cells");

  const std::string whole = read_text(folder.path() / "swirl.epm");
  folder.file("cut.epm", whole.substr(0, whole.size() - 1));
  const CommandResult cut = run_etalon({"progressive", "cut.epm", "--faces", "9999", "-o", "cut.ply"}, {.folder = folder.path()});
  CHECK(cut.exit_code == 0);
  CHECK(cut.out.find("is cut short") != std::string::npos);
  folder.file("half.epm", whole.substr(0, whole.size() / 2));
  const json cut_document = checked_document(
      run_etalon({"progressive", "half.epm", "--faces", "9999", "-o", "cut.ply", "--json", "-"}, {.folder = folder.path()}),
      "progressive.json");
  CHECK(cut_document["complete"] == false);
  CHECK(cut_document["records"].get<std::size_t>() < cut_document["records_in_whole"].get<std::size_t>());
  CHECK(without["complete"] == true);
  folder.file("broken.epm", whole.substr(0, 30));
  check_refused({"progressive", "broken.epm", "--faces", "3", "-o", "b.ply"}, 4, folder,
                "broken.epm: byte 8: the file ends inside its HEAD chunk");
  check_refused({"info", "broken.epm"}, 4, folder, "broken.epm: byte 8");
  CHECK(run_etalon({"info", "cut.epm"}, {.folder = folder.path()}).out.find("cut short") != std::string::npos);
  check_refused({"progressive", "swirl.epm", "-o", "b.ply"}, 64, folder, "expected --faces N");
  check_refused({"progressive", "swirl.obj", "-o", "b.ply"}, 64, folder, "expected a model and -o FILE.epm");
  check_refused({"progressive", "swirl.epm", "--faces", "3", "-o", "b.epm"}, 64, folder, "expected a model and -o FILE.epm");
  check_refused({"progressive", "missing.obj", "-o", "b.epm"}, 4, folder, "missing.obj");
}

TEST_CASE("progressive: full-edge collapses; a level of the file is the simplified model") {
  const ScratchFolder folder;
  REQUIRE(run_etalon({"make", "swirl", "--faces", "800", "--texture-size", "64", "-o", "swirl.obj"}, {.folder = folder.path()}).exit_code ==
          0);
  const CommandResult made = run_etalon(
      {"progressive", "swirl.obj", "--collapse", "full", "--metric", "qem5", "-o", "swirl.epm", "--json", "-"}, {.folder = folder.path()});
  REQUIRE(made.exit_code == 0);
  CHECK(checked_document(made, "progressive.json")["collapse"] == "full");
  REQUIRE(run_etalon({"progressive", "swirl.epm", "--faces", "300", "-o", "level.obj"}, {.folder = folder.path()}).exit_code == 0);
  REQUIRE(run_etalon({"simplify", "swirl.obj", "--collapse", "full", "--metric", "qem5", "--faces", "300", "-o", "direct.obj"},
                     {.folder = folder.path()})
              .exit_code == 0);
  CHECK(json::parse(
            run_etalon({"metro", "level.obj", "direct.obj", "--samples", "1000", "--json", "-"}, {.folder = folder.path()}).out)["max"] <
        1e-12);
  check_refused({"progressive", "swirl.obj", "--collapse", "full", "--metric", "aps", "-o", "b.epm"}, 64, folder, "--collapse half");
  check_refused({"progressive", "swirl.epm", "--faces", "3", "--collapse", "full", "-o", "b.ply"}, 64, folder, "--collapse");
}

TEST_CASE("progressive: materials keep their names and their faces") {
  const ScratchFolder folder;
  folder.file("two.mtl", "newmtl wood\nnewmtl old skin\n");
  folder.file("two.obj", "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl old skin\nf 1 2 3\nusemtl wood\nf 1 3 4\n");
  REQUIRE(run_etalon({"progressive", "two.obj", "-o", "two.epm"}, {.folder = folder.path()}).exit_code == 0);
  REQUIRE(run_etalon({"progressive", "two.epm", "--faces", "2", "-o", "again.obj"}, {.folder = folder.path()}).exit_code == 0);
  const std::string again = read_text(folder.path() / "again.obj");
  const auto skin = again.find("usemtl old skin\n"), wood = again.find("usemtl wood\n");
  REQUIRE(skin != std::string::npos);
  REQUIRE(wood != std::string::npos);
  CHECK(again.find("f 1", skin) < wood);
  CHECK(read_text(folder.path() / "again.mtl").find("newmtl wood") != std::string::npos);
}

TEST_CASE("metro: the document, the same bytes for every thread count, colours where both have them") {
  const ScratchFolder folder;
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
      "property uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  folder.file("a.ply", header + "0 0 0 255 0 0\n3 0 0 255 0 0\n0 4 0 255 0 0\n3 0 1 2\n");
  folder.file("b.ply", header + "0 0 2 0 0 0\n3 0 2 0 0 0\n0 4 2 0 0 0\n3 0 1 2\n");
  folder.file("plain.obj", "v 0 0 0\nv 3 0 0\nv 0 4 0\nf 1 2 3\n");
  std::string first;
  for (const char* threads : {"1", "2", "7"}) {
    const CommandResult result =
        run_etalon({"metro", "a.ply", "b.ply", "--samples", "5000", "--threads", threads, "--json", "-"}, {.folder = folder.path()});
    REQUIRE(result.exit_code == 0);
    json document = checked_document(result, "metro.json");
    CHECK(document["diagonal"] == 5);
    CHECK(document["forward"]["mean"] == 2);
    CHECK(document["max_of_diagonal"].get<double>() == 0.4);
    CHECK(document["colour_rms"] == 1);
    CHECK(document["forward"]["samples"] == 5000);
    document.erase("run");
    if (first.empty()) first = document.dump();
    CHECK(document.dump() == first);
  }
  const CommandResult plain = run_etalon({"metro", "a.ply", "plain.obj", "--json", "-"}, {.folder = folder.path()});
  CHECK(checked_document(plain, "metro.json")["colour_rms"].is_null());
  const CommandResult lines = run_etalon({"metro", "a.ply", "b.ply", "--samples", "100"}, {.folder = folder.path()});
  CHECK(lines.out.find("A to B: mean 2 (40.0000 %)") != std::string::npos);
  CHECK(lines.out.find("colour RMS 1.00000") != std::string::npos);
}

TEST_CASE("metro: refusals") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  check_refused({"metro", "square.obj"}, 64, folder, "metro:");
  check_refused({"metro", "square.obj", "square.obj", "--samples", "0"}, 64, folder, "samples");
  check_refused({"metro", "square.obj", "square.obj", "--json", "square.obj"}, 64, folder, "would overwrite surface a");
  check_refused({"metro", "square.obj", "missing.obj"}, 4, folder, "missing.obj");
}

TEST_CASE("simplify: numbers that are none or out of range are a usage error") {
  const ScratchFolder folder;
  REQUIRE(run_etalon({"make", "knot", "--faces", "2000", "-o", "knot.ply"}, {.folder = folder.path()}).exit_code == 0);
  const std::vector<std::string> head = {"simplify", "knot.ply", "-o", "out.ply"};
  const std::vector<std::vector<std::string>> wrong = {{"--ratio", "nan"},
                                                       {"--ratio", "1.5"},
                                                       {"--ratio", "0.5", "--min-cosine", "nan"},
                                                       {"--ratio", "0.5", "--metric", "qem6", "--weight", "nan"},
                                                       {"--ratio", "0.5", "--metric", "qem6", "--weight", "0"},
                                                       {"--ratio", "0.5", "--metric", "qem6", "--weight", "1e5"}};
  for (const std::vector<std::string>& rest : wrong) {
    std::vector<std::string> arguments = head;
    arguments.insert(arguments.end(), rest.begin(), rest.end());
    check_refused(arguments, 64, folder, "expected a number from");
  }
  for (const std::string unit : {"nan", "-1", "1e-300", "0%", "1e300%", "1%%"})
    check_refused({"simplify", "knot.ply", "-o", "out.ply", "--ratio", "0.5", "--metric", "kim", "--unit", unit}, 64, folder,
                  "--unit: expected a length");
}

TEST_CASE("simplify: --unit as a share of the diagonal; the error is named as what the metric measures") {
  const ScratchFolder folder;
  REQUIRE(run_etalon({"make", "knot", "--faces", "2000", "-o", "knot.ply"}, {.folder = folder.path()}).exit_code == 0);
  const auto simplified = [&](const std::string& metric, const std::string& unit) {
    std::vector<std::string> arguments{"simplify", "knot.ply", "-o", "out.ply", "--ratio", "0.5", "--metric", metric};
    if (!unit.empty()) arguments.insert(arguments.end(), {"--unit", unit});
    return run_etalon(arguments, {.folder = folder.path()});
  };
  const CommandResult share = simplified("kim", "0.0125%"), plain = simplified("kim", "");  // the default: an 8000th
  CHECK(share.exit_code == 0);
  CHECK(share.out == plain.out);
  CHECK(simplified("kim", "10%").out != plain.out);
  CHECK(plain.out.find("; RMS distance to planes ") != std::string::npos);
  CHECK(simplified("qem6", "").out.find("; RMS error in space and colour together ") != std::string::npos);
}

TEST_CASE("progressive: what was repaired, a target that is not reached, options that do not belong, a model without faces") {
  const ScratchFolder folder;
  folder.file("book.obj", book_obj());
  const CommandResult book = run_etalon({"progressive", "book.obj", "--faces", "1", "-o", "book.epm"}, {.folder = folder.path()});
  CAPTURE(book.err);
  CHECK(book.exit_code == 1);
  CHECK(book.out.find("edges of more than two faces") != std::string::npos);
  CHECK(book.out.find("stopped above the 1 faces asked for") != std::string::npos);
  const CommandResult level = run_etalon({"progressive", "book.epm", "--faces", "1", "-o", "level.ply"}, {.folder = folder.path()});
  CHECK(level.exit_code == 1);
  CHECK(level.out.find("the base has more than") != std::string::npos);
  check_refused({"progressive", "book.epm", "--faces", "3", "--metric", "kim", "-o", "other.ply"}, 64, folder, "--metric");
  folder.file("flat.obj", "v 0 0 0\nv 1 0 0\nf 1 2 1\nf 2 1 2\n");
  check_refused({"progressive", "flat.obj", "-o", "flat.epm"}, 4, folder, "three different vertices");
}
