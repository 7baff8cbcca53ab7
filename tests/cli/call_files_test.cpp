// No call overwrites what it reads, nor writes one file twice.
#include "cli/call_files.h"

#include <filesystem>

#include <doctest/doctest.h>

#include "cli/usage_error.h"
#include "tests/cli/run_command.h"

using namespace etalon::test;
using etalon::cli::CallFiles;
using etalon::cli::UsageError;

TEST_CASE("call files: the same file under other names") {
  const ScratchFolder folder;
  const std::string file = folder.file("a.png", "x");
  std::filesystem::create_symlink("a.png", folder.path() / "link.png");
  for (const std::string& other : {file, (folder.path() / "." / "a.png").string(), (folder.path() / "no/../a.png").string(),
                                   (folder.path() / "link.png").string(), std::filesystem::relative(file).string()}) {
    CAPTURE(other);
    CallFiles input_first;
    input_first.add_input(file, "in");
    CHECK_THROWS_AS(input_first.add_output(other, "out"), UsageError);
    CallFiles output_first;
    output_first.add_output(other, "out");
    CHECK_THROWS_AS(output_first.add_input(file, "in"), UsageError);
    CHECK_THROWS_AS(output_first.add_output(file, "other"), UsageError);
  }
  CallFiles fine;
  fine.add_input(file, "in");
  CHECK_NOTHROW(fine.add_input(file, "in"));
  for (const char* nobody : {"", "-", "/dev/null"}) {
    CHECK_NOTHROW(fine.add_output(nobody, "out"));
    CHECK_NOTHROW(fine.add_output(nobody, "out"));
  }
  CHECK_NOTHROW(fine.add_output((folder.path() / "b.png").string(), "out"));
}

TEST_CASE("the example of the help keeps the texture, and make names every file it writes") {
  const ScratchFolder folder;
  const CommandOptions here{.folder = folder.path()};
  const CommandResult made =
      run_etalon({"make", "head", "--faces", "200", "--texture-size", "64", "-o", "head.obj", "--json", "head.json"}, here);
  CHECK(made.exit_code == 0);
  for (const std::string& name : folder.listing()) {
    CAPTURE(name);
    CHECK(made.out.find("wrote " + name + "\n") != std::string::npos);
  }
  const std::string texture = read_text(folder.path() / "head_texture.png");
  REQUIRE_FALSE(texture.empty());
  CHECK(run_etalon({"render", "head.obj", "--size", "32", "-o", "head.png"}, here).exit_code == 0);
  CHECK(read_text(folder.path() / "head_texture.png") == texture);
}

TEST_CASE("an output that is an input or another output: 64, and nothing changes") {
  const ScratchFolder folder;
  const CommandOptions here{.folder = folder.path()};
  REQUIRE(run_etalon({"make", "swirl", "--faces", "8", "--texture-size", "64", "-o", "m.obj"}, here).exit_code == 0);
  folder.file("view.json",
              R"({"schema":"etalon/view/1","eye":[0,0,4],"target":[0,0,0],"up":[0,1,0],"tan_half_fov_y":0.5,"near":0.5,"far":10})");
  std::filesystem::create_directory(folder.path() / "report");
  std::filesystem::copy_file(folder.path() / "m.obj", folder.path() / "report/index.html");
  std::filesystem::copy_file(folder.path() / "m_texture.png", folder.path() / "t.png");
  std::vector<std::string> before;
  const auto contents = [&] {
    std::vector<std::string> all = folder.listing();
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
      if (entry.is_regular_file()) all.push_back(read_text(entry.path()));
    return all;
  };
  before = contents();
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"info", "m.obj", "--json", "m.obj"},
           {"info", "m.obj", "--json", "./m.mtl"},
           {"info", "m.obj", "--json", "m_texture.png"},
           {"render", "m.obj", "-o", "m_texture.png"},
           {"render", "m.obj", "-o", "t.png", "--texture", "t.png"},
           {"render", "m.obj", "-o", "m_texture.png", "--texture", "t.png"},
           {"render", "m.obj", "-o", "x.png", "--json", "x.png"},
           {"render", "m.obj", "-o", "x.png", "--json", "m.obj"},
           {"render", "m.obj", "-o", "x.png", "--json", "view.json", "--view", "view.json"},
           {"make", "head", "-o", "m.obj", "--json", "m.obj"},
           {"make", "head", "-o", "m.obj", "--json", "m.mtl"},
           {"make", "head", "-o", "m.obj", "--json", "m_texture.png"},
           {"verify", "m.obj", "--json", "m.obj"},
           {"verify", "m.obj", "--json", "view.json", "--view", "view.json"},
           {"verify", "m.obj", "--json", "m_texture.png"},
           {"verify", "m.obj", "--json", "t.png", "--texture", "t.png"},
           {"verify", "m.obj", "--json", "new/verify.json", "--report", "new"},
           {"verify", "m.obj", "--report", "report", "--texture", "report/index.html"},
       }) {
    std::string shown;
    for (const std::string& argument : arguments) shown += argument + " ";
    CAPTURE(shown);
    const CommandResult result = run_etalon(arguments, here);
    CAPTURE(result.err);
    CHECK(result.exit_code == 64);
    CHECK(result.error_lines().size() == 1);
    CHECK(result.err.find("would overwrite") != std::string::npos);
    CHECK(contents() == before);
  }
}
