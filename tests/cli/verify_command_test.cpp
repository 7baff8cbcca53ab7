#include <array>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "cli/verify_command.h"
#include "tests/cli/run_command.h"
#include "tests/support/skip.h"

using namespace etalon::test;
using nlohmann::json;

namespace {

bool has_gl(const CommandResult& result) { return result.out.find("GL: not available") == std::string::npos; }

}  // namespace

TEST_CASE("verify: table, report line, exit code") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  const CommandResult result = run_etalon({"verify", "square.obj", "--size", "96x64"}, {.folder = folder.path()});
  CAPTURE(result.out);
  CHECK(result.err.empty());
  CHECK(result.out.find("unbounded") != std::string::npos);
  CHECK(result.out.find("\nreport: file:///") != std::string::npos);
  CHECK(result.out.find("note: no texture and no colours: drawn with a checkerboard") != std::string::npos);
  CHECK(folder.listing() == std::vector<std::string>{"etalon-report", "etalon-report/classes.csv", "etalon-report/index.html",
                                                     "etalon-report/verify.json", "square.obj"});
  if (!has_gl(result)) {
    report_skip("verify: table, report line, exit code", "no OpenGL: comparison not tested");
    CHECK(result.exit_code == 1);
    return;
  }
  CHECK(result.exit_code == 0);
  const json document = json::parse(read_text(folder.path() / "etalon-report/verify.json"));
  CHECK(document["verdict"] == "agreed");
  CHECK(document["total"]["unexplained"] == 0);
  CHECK(document["total"]["texels"] == (8 + 6) * 96 * 64);
}

TEST_CASE("verify without OpenGL says why, draws what it can, and exits with 1") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  // Mesa then offers less than the 3.3 that is needed: the same path as a missing library.
  const CommandResult result =
      run_etalon({"verify", "square.obj", "--size", "32"},
                 {.folder = folder.path(), .environment = {"MESA_GL_VERSION_OVERRIDE=2.1", "MESA_GLSL_VERSION_OVERRIDE=120"}});
  CAPTURE(result.out);
  CHECK(result.exit_code == 1);
  CHECK(result.err.empty());
  CHECK(result.out.find("GL: not available (") != std::string::npos);
  CHECK(result.out.find("compared nothing") != std::string::npos);
  const json document = json::parse(read_text(folder.path() / "etalon-report/verify.json"));
  CHECK(document["verdict"] == "not_compared");
  CHECK(document["renderers"]["gl"].is_null());
  CHECK(document["total"]["texels"] == 0);

  const CommandResult render = run_etalon({"render", "square.obj", "--backend", "gl", "-o", "a.png"},
                                          {.folder = folder.path(), .environment = {"MESA_GL_VERSION_OVERRIDE=2.1"}});
  CHECK(render.exit_code == 1);
  CHECK(render.error_lines().size() == 1);
}

TEST_CASE("--context egl: the same llvmpipe as by OSMesa, the same bytes") {
  const ScratchFolder folder;
  REQUIRE(run_etalon({"make", "swirl", "-o", "swirl.obj"}, {.folder = folder.path()}).exit_code == 0);
  std::vector<std::string> bytes;
  for (const char* context : {"osmesa", "egl"}) {
    const CommandResult result = run_etalon({"render", "swirl.obj", "--backend", "gl", "--driver", "llvmpipe", "--context", context,
                                             "--filter", "linear", "--size", "300", "-o", "swirl.exr"},
                                            {.folder = folder.path()});
    if (result.exit_code == 1) return report_skip("--context egl", result.err);
    REQUIRE(result.exit_code == 0);
    bytes.push_back(read_text(folder.path() / "swirl.exr"));
  }
  CHECK(bytes[0] == bytes[1]);
}

TEST_CASE("--shader exact: every texel identical, no bound lent; the report names the mode") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  const CommandResult result = run_etalon({"verify", "square.obj", "--size", "96x64", "--shader", "exact"}, {.folder = folder.path()});
  CAPTURE(result.out);
  if (!has_gl(result)) return report_skip("--shader exact", "no OpenGL: comparison not tested");
  CHECK(result.exit_code == 0);
  const json document = json::parse(read_text(folder.path() / "etalon-report/verify.json"));
  CHECK(document["verdict"] == "agreed");
  CHECK(document["total"]["identical"] == (8 + 6) * 96 * 64);
  CHECK(document["bounds"]["origin"] == "exact: docs/contract.md, version 1");
  CHECK(document["renderers"]["gl"].get<std::string>().find(", exact shader") != std::string::npos);

  std::array<json, 2> drawn;
  for (std::size_t side = 0; side < 2; ++side) {
    drawn[side] = json::parse(run_etalon({"render", "square.obj", "--size", "64", "--filter", "linear", "--backend",
                                          side == 0 ? "cpu" : "gl", "--shader", "exact", "-o", "a.exr", "--json", "-"},
                                         {.folder = folder.path()})
                                  .out);
  }
  CHECK(drawn[0]["targets"] == drawn[1]["targets"]);

  const CommandResult softpipe =
      run_etalon({"verify", "square.obj", "--size", "32", "--driver", "softpipe", "--shader", "exact"}, {.folder = folder.path()});
  CHECK(softpipe.exit_code == 1);
  CHECK(softpipe.out.find("the exact shader needs version 4.0") != std::string::npos);
}

TEST_CASE("a model without texture coordinates: the indexed job is skipped, not an error") {
  const ScratchFolder folder;
  folder.file("plain.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
  const CommandResult result = run_etalon({"verify", "plain.obj", "--size", "32"}, {.folder = folder.path()});
  CAPTURE(result.out);
  CHECK(result.out.find("skipped: no texture coordinates (try ") != std::string::npos);
  const json document = json::parse(read_text(folder.path() / "etalon-report/verify.json"));
  CHECK(document["jobs"][1]["job"] == "indexed");
  CHECK(document["jobs"][1].contains("skipped"));
  CHECK(document["jobs"][0]["cases"][0]["sampling"] == "vertex colours");
  const CommandResult only = run_etalon({"verify", "plain.obj", "--size", "32", "--jobs", "indexed"}, {.folder = folder.path()});
  CHECK(only.exit_code == 1);
}

TEST_CASE("verify: the job bake, on the command line, in the table and in the document; skipped with a hint where there are no colours") {
  const ScratchFolder folder;
  REQUIRE(run_etalon({"make", "swirl", "--faces", "512", "--texture-size", "64", "-o", "swirl.obj"}, {.folder = folder.path()}).exit_code ==
          0);
  const CommandResult result = run_etalon({"verify", "swirl.obj", "--size", "128", "--jobs", "bake"}, {.folder = folder.path()});
  CAPTURE(result.out);
  CHECK(result.err.empty());
  const json document = json::parse(read_text(folder.path() / "etalon-report/verify.json"));
  REQUIRE(document["jobs"].size() == 1);
  const json& job = document["jobs"][0];
  CHECK(job["job"] == "bake");
  CHECK(!job.contains("skipped"));
  REQUIRE(job["cases"].size() == 2);
  std::vector<std::string> hashes;
  for (const json& item : job["cases"]) {
    CHECK(item["covered"] > 1000);
    CHECK(item["unexplained"] == 0);
    hashes.push_back(item["targets"][0]["cpu_sha256"]);
    const std::string name = "swirl, " + item["view"].get<std::string>() + ", " + item["sampling"].get<std::string>();
    CHECK(result.out.find("\nbake     " + name + ": 128x128, cpu ") != std::string::npos);
    CHECK(read_text(folder.path() / "etalon-report/classes.csv").find("\nbake,") != std::string::npos);
  }
  CHECK(job["cases"][0]["sampling"].get<std::string>().find(" of 512 faces") != std::string::npos);
  if (has_gl(result)) {
    CHECK(result.exit_code == 0);
    CHECK(job["texels"] == 2 * 128 * 128);
  } else {
    report_skip("verify: the job bake", "no OpenGL: comparison not tested");
    CHECK(result.exit_code == 1);
  }

  REQUIRE(run_etalon({"verify", "swirl.obj", "--size", "16", "--jobs", "bake", "--faces", "80"}, {.folder = folder.path()}).err.empty());
  const json asked = json::parse(read_text(folder.path() / "etalon-report/verify.json"));
  CHECK(asked["jobs"][0]["cases"][0]["triangles"] <= 80);
  CHECK(asked["jobs"][0]["cases"][0]["triangles"] > 60);

  folder.file("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const CommandResult bare = run_etalon({"verify", "bare.obj", "--size", "16", "--jobs", "bake"}, {.folder = folder.path()});
  CHECK(bare.exit_code == 1);
  CHECK(bare.err.empty());
  CHECK(bare.out.find("skipped: neither vertex colours nor a texture with coordinates to take them from (try ") != std::string::npos);
}

TEST_CASE("views: built-in names and a file") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  folder.file("near.json",
              R"({"schema":"etalon/view/1","eye":[0,0,4],"target":[0,0,0],"up":[0,1,0],"tan_half_fov_y":0.5,"near":0.5,"far":10})");
  const CommandResult result = run_etalon(
      {"verify", "square.obj", "--size", "32", "--jobs", "render", "--view", "near.json", "--view", "3/24"}, {.folder = folder.path()});
  CAPTURE(result.err);
  const json document = json::parse(read_text(folder.path() / "etalon-report/verify.json"));
  REQUIRE(document["jobs"][0]["cases"].size() == 4);
  CHECK(document["jobs"][0]["cases"][0]["view"] == "near.json");
  CHECK(document["jobs"][0]["cases"][2]["view"] == "3/24");
}

TEST_CASE("a view file says how large the frame is, unless --size does") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  const auto view = [&](const char* name, const char* size) {
    folder.file(name, std::string(R"({"schema":"etalon/view/1","eye":[0,0,4],"target":[0,0,0],"up":[0,1,0],"tan_half_fov_y":0.5,)") + size +
                          R"("near":0.5,"far":10})");
  };
  view("wide.json", R"("width":48,"height":20,)");
  view("tall.json", R"("width":20,"height":48,)");
  view("any.json", "");
  const auto size_of = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render", "square.obj", "-o", "a.png", "--json", "-"});
    const json document = json::parse(run_etalon(arguments, {.folder = folder.path()}).out);
    return std::pair<int, int>(document["width"], document["height"]);
  };
  CHECK(size_of({"--view", "wide.json"}) == std::pair(48, 20));
  CHECK(size_of({"--view", "wide.json", "--size", "16"}) == std::pair(16, 16));
  CHECK(size_of({"--view", "any.json"}) == std::pair(1024, 1024));
  const std::vector<std::string> verify{"verify", "square.obj", "--jobs", "render", "--view", "wide.json", "--view", "any.json"};
  const CommandResult same = run_etalon(verify, {.folder = folder.path()});
  CHECK(same.out.find(": 48x20, ") != std::string::npos);
  std::vector<std::string> differing = verify;
  differing.insert(differing.end(), {"--view", "tall.json"});
  const CommandResult refused = run_etalon(differing, {.folder = folder.path()});
  CHECK(refused.exit_code == 64);
  CHECK(refused.err.find("give --size") != std::string::npos);
}

TEST_CASE("the document may go into the folder of a report that is still to be made") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  const CommandResult result = run_etalon(
      {"verify", "square.obj", "--size", "16", "--report", "new/report", "--json", "new/report/mine.json"}, {.folder = folder.path()});
  CAPTURE(result.err);
  CHECK((result.exit_code == 0 || result.exit_code == 1));  // 1: no OpenGL on this machine
  CHECK(read_text(folder.path() / "new/report/mine.json").find("etalon/verify/1") != std::string::npos);
}

TEST_CASE("--quiet: one line on standard error where the exit code is not 0") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  const CommandResult result = run_etalon({"verify", "square.obj", "--size", "16", "--quiet"},
                                          {.folder = folder.path(), .environment = {"MESA_GL_VERSION_OVERRIDE=2.1"}});
  CHECK(result.exit_code == 1);
  CHECK(result.out.empty());
  REQUIRE(result.error_lines().size() == 1);
  CHECK(result.error_lines()[0].rfind("etalon: warning: compared nothing: GL: not available (", 0) == 0);

  etalon::validation::VerifyResult failed;
  failed.jobs.resize(1);
  failed.jobs[0].cases.resize(1);
  failed.jobs[0].cases[0].tally = {.texels = 10, .identical = 8, .unexplained = 2};
  CHECK(etalon::cli::quiet_outcome(failed, "report/index.html") == "2 texels unexplained, see report/index.html");
  failed.jobs[0].cases[0].tally = {.texels = 10, .identical = 9, .unexplained = 1};
  CHECK(etalon::cli::quiet_outcome(failed, "p") == "1 texel unexplained, see p");
}

TEST_CASE("a line stays one line whatever a file's name holds") {
  const ScratchFolder folder;
  folder.file("red\x1b[31m\nname.obj", square_obj());
  const CommandResult result =
      run_etalon({"render", "red\x1b[31m\nname.obj", "--size", "16", "-o", "a\x1b[31m\n.png"}, {.folder = folder.path()});
  CHECK(result.exit_code == 0);
  CHECK(result.out.find('\x1b') == std::string::npos);
  CHECK(result.out.find("a\\x1b[31m .png: 16x16, 2 triangles") != std::string::npos);
}

TEST_CASE("--quiet prints nothing where the sides agree") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  const CommandResult result = run_etalon({"verify", "square.obj", "--size", "16", "--quiet"}, {.folder = folder.path()});
  CHECK(result.out.empty());
  CHECK(result.err.empty() == (result.exit_code == 0));
}
