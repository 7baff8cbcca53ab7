// FILE.draws through the program: what is handed out draws the same bytes again, on both sides; what a stranger wrote is drawn.
#include <cstdlib>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/run_command.h"
#include "tests/cli/schema_validator.h"
#include "tests/support/skip.h"

using namespace etalon::test;
using nlohmann::json;

namespace {

json header_of(const std::string& file) {
  const std::string bytes = read_text(file);
  REQUIRE(bytes.substr(0, 8) == "etalonDR");
  std::size_t size = 0;
  for (int i = 7; i >= 0; --i) size = size << 8 | static_cast<unsigned char>(bytes[8 + static_cast<std::size_t>(i)]);
  return json::parse(bytes.substr(16, size));
}

void check_header(const std::string& file) {
  const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/draws.json"));
  for (const std::string& violation : schema_violations(schema, header_of(file))) FAIL_CHECK(violation);
}

std::string colored_ply() {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty "
         "uchar green\n"
         "property uchar blue\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
         "-1 -1 0 255 0 0\n1 -1 0 0 255 0\n1 1 0.5 0 0 255\n-1 1 0 90 90 90\n3 0 1 2\n3 0 2 3\n";
}

}  // namespace

TEST_CASE("draws: textured and coloured models draw the same bytes again, at several sub-texel precisions, clipped and not") {
  const ScratchFolder folder;
  folder.file("square.ply", colored_ply());
  REQUIRE(run_etalon({"make", "swirl", "--faces", "200", "--texture-size", "64", "-o", "swirl.obj"}, {.folder = folder.path()}).exit_code ==
          0);
  folder.file("near.json",
              R"({"schema":"etalon/view/1","eye":[0.3,0.2,0.4],"target":[0,0,0],"up":[0,1,0],"tan_half_fov_y":0.9,"near":0.35,"far":10})");
  for (const std::string model : {"swirl.obj", "square.ply"})
    for (const std::string bits : {"1", "4", "8", "16"})
      for (const std::string view : {"fit", "near.json"}) {
        CAPTURE(model + " " + bits + " " + view);
        const CommandResult first = run_etalon({"render", model, "--size", "70x50", "--snap-bits", bits, "--view", view, "--filter",
                                                "linear", "--write-draws", "a.draws", "-o", "a.png"},
                                               {.folder = folder.path()});
        REQUIRE_MESSAGE(first.exit_code == 0, first.err);
        const CommandResult again = run_etalon({"render", "a.draws", "--write-draws", "b.draws", "-o", "b.png"}, {.folder = folder.path()});
        REQUIRE_MESSAGE(again.exit_code == 0, again.err);
        CHECK(read_text(folder.path() / "a.png") == read_text(folder.path() / "b.png"));
        CHECK(header_of(folder.path() / "a.draws")["state"] == header_of(folder.path() / "b.draws")["state"]);
        check_header(folder.path() / "a.draws");
      }
}

TEST_CASE("draws: the margins picture names the draws written beside it") {
  const ScratchFolder folder;
  folder.file("square.ply", colored_ply());
  const CommandResult made =
      run_etalon({"render", "square.ply", "--size", "40", "--margins", "--write-draws", "a.draws", "-o", "a.exr", "--json", "-"},
                 {.folder = folder.path()});
  REQUIRE_MESSAGE(made.exit_code == 0, made.err);
  const json document = json::parse(made.out);
  const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/render.json"));
  for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
  const json info = json::parse(run_etalon({"info", "a.exr", "--json", "-"}, {.folder = folder.path()}).out);
  CHECK(info["attributes"]["drawsFile"] == "a.draws");
  CHECK(info["attributes"]["drawsFileSha256"] == document["draws"]["sha256"]);
  CHECK(info["attributes"]["drawListSha256"] == document["draw_list_sha256"]);
  const CommandResult again = run_etalon({"render", "a.draws", "-o", "b.exr", "--json", "-"}, {.folder = folder.path()});
  REQUIRE_MESSAGE(again.exit_code == 0, again.err);
  const json drawn = json::parse(again.out);
  for (const std::string& violation : schema_violations(schema, drawn)) FAIL_CHECK(violation);
  CHECK(drawn["targets"] == document["targets"]);
  CHECK(drawn["draw_list_sha256"] == document["draw_list_sha256"]);
}

TEST_CASE("draws: OpenGL draws them too") {
  const ScratchFolder folder;
  folder.file("square.ply", colored_ply());
  const CommandResult made = run_etalon(
      {"render", "square.ply", "--size", "40", "--backend", "gl", "--write-draws", "a.draws", "-o", "a.png"}, {.folder = folder.path()});
  if (made.exit_code == 1) return report_skip("draws on OpenGL", made.err);
  REQUIRE_MESSAGE(made.exit_code == 0, made.err);
  CHECK(run_etalon({"render", "a.draws", "--backend", "gl", "-o", "b.png"}, {.folder = folder.path()}).exit_code == 0);
  CHECK(read_text(folder.path() / "a.png") == read_text(folder.path() / "b.png"));
}

TEST_CASE("draws: the example in Python writes what is drawn") {
  const ScratchFolder folder;
  if (std::system("python3 -c '' >/dev/null 2>&1") != 0) return report_skip("the example in Python", "no python3");
  const std::string command = "cd '" + folder.path().string() + "' && python3 '" + ETALON_EXAMPLES + "/write_draws.py'";
  REQUIRE(std::system(command.c_str()) == 0);
  check_header(folder.path() / "square.draws");
  const CommandResult drawn = run_etalon({"render", "square.draws", "-o", "square_drawn.png", "--json", "-"}, {.folder = folder.path()});
  REQUIRE_MESSAGE(drawn.exit_code == 0, drawn.err);
  const json document = json::parse(drawn.out);
  CHECK(document["width"] == 64);
  CHECK(document["triangles"] == 2);
  // The same bytes on every machine: the square as a trapezium, its texture foreshortened.
  CHECK(document["targets"][0]["sha256"] == "20d9cd96abcdd65c55eeea84f857571f5638f459f453c630becbc1cf0f520dca");
}

TEST_CASE("draws: what cannot be, is refused") {
  const ScratchFolder folder;
  folder.file("square.ply", colored_ply());
  folder.file("text.draws", "hello");
  REQUIRE(
      run_etalon({"render", "square.ply", "--size", "8", "--write-draws", "a.draws", "-o", "a.png"}, {.folder = folder.path()}).exit_code ==
      0);
  for (const std::string option : {"--view=fit", "--size=8", "--filter=linear", "--texture=a.png", "--flip-v", "--snap-bits=8"})
    check_refused({"render", "a.draws", option, "-o", "b.png"}, 64, folder, "says itself how it is drawn");
  check_refused({"render", "square.ply", "--write-draws", "b.txt", "-o", "b.png"}, 64, folder, "ends in .draws");
  check_refused({"render", "square.ply", "--write-draws", "", "-o", "b.png"}, 64, folder, "--write-draws: expected a value");
  check_refused({"render", "a.draws", "--write-draws", "a.draws", "-o", "b.png"}, 64, folder, "a.draws");
  check_refused({"render", "text.draws", "-o", "b.png"}, 4, folder, "text.draws: expected the signature");
  check_refused({"render", "missing.draws", "-o", "b.png"}, 4, folder, "missing.draws");
  check_refused({"render", "square.ply", "--write-draws", "none/b.draws", "-o", "b.png"}, 4, folder, "none");
  check_refused({"render", "square.obj", "--texture", "a.png", "--write-draws", "b.draws", "-o", "b.0.png"}, 4, folder, "square.obj");
}

TEST_CASE("draws: a texture that would overwrite the picture is refused") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  check_refused({"render", "square.obj", "--size", "8", "--write-draws", "b.draws", "-o", "b.0.png"}, 64, folder, "b.0.png");
}
