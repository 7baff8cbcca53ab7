// Every refusal: the exit code, exactly one line on standard error, nothing written.
#include <unistd.h>

#include <filesystem>

#include <doctest/doctest.h>

#include "tests/cli/run_command.h"
#include "tests/support/skip.h"

using namespace etalon::test;

TEST_CASE("usage: 64") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  check_refused({}, 64, folder, "verb");
  check_refused({"verfy"}, 64, folder, "did you mean 'verify'?");
  check_refused({"frobnicate"}, 64, folder, "unknown verb 'frobnicate'");
  check_refused({"--frobnicate"}, 64, folder, "");
  check_refused({"render"}, 64, folder, "render:");
  check_refused({"render", "square.obj"}, 64, folder, "output");
  check_refused({"render", "square.obj", "-o", "a.jpg"}, 64, folder, ".png or .exr");
  check_refused({"render", "square.obj", "-o", "a.png", "--margins"}, 64, folder, "OpenEXR");
  check_refused({"render", "square.obj", "-o", "a.exr", "--margins", "--backend", "gl"}, 64, folder, "--backend cpu");
  check_refused({"render", "square.obj", "-o", "a.png", "--view", "sideways"}, 64, folder, "sideways");
  check_refused({"render", "square.obj", "-o", "a.png", "--view", "24/24"}, 64, folder, "24/24");
  check_refused({"render", "square.obj", "-o", "-", "--json", "-"}, 64, folder, "standard output");
  check_refused({"make", "teapot", "-o", "a.obj"}, 64, folder, "teapot");
  check_refused({"make", "swirl", "-o", "-"}, 64, folder, "FILE");
  check_refused({"make", "swirl", "--faces", "0", "-o", "a.obj"}, 64, folder, "expected 2 to 2000000, got 0");
  check_refused({"make", "swirl", "--faces", "1", "-o", "a.obj"}, 64, folder, "expected 2 to 2000000, got 1");
  check_refused({"make", "head", "--faces", "71", "-o", "a.obj"}, 64, folder, "expected 72 to 2000000, got 71");
  check_refused({"make", "head", "--faces", "2000001", "-o", "a.obj"}, 64, folder, "got 2000001");
  check_refused({"make", "head", "--faces", "many", "-o", "a.obj"}, 64, folder, "faces");
  check_refused({"make", "monkey", "--faces", "20001", "-o", "a.ply"}, 64, folder, "expected an even number, got 20001");
  check_refused({"make", "statue", "--faces", "39998", "-o", "a.ply"}, 64, folder, "expected 40000 to 10000000, got 39998");
  check_refused({"make", "duck", "--texture-size", "64", "-o", "a.ply"}, 64, folder, "duck is coloured by vertex");
  check_refused({"make", "knot", "--open", "-o", "a.ply"}, 64, folder, "--open is of duck");
  check_refused({"make", "head", "-o", ""}, 64, folder, "output");
  check_refused({"verify", "--texture", "a.png"}, 64, folder, "--texture needs a MODEL");
  check_refused({"verify", "--flip-v"}, 64, folder, "--flip-v needs a MODEL");
  check_refused({"verify", "square.obj", "--texture", ""}, 64, folder, "--texture: expected a value");
  check_refused({"render", "square.obj", "-o", "a.png", "--texture", ""}, 64, folder, "--texture: expected a value");
  check_refused({"verify", "square.obj", "--report", ""}, 64, folder, "--report: expected a value");
  check_refused({"info", "square.obj", "--json", ""}, 64, folder, "--json: expected a value");
  check_refused({"render", "square.obj", "-o", "a.png", "--size", ""}, 64, folder, "--size: expected a value");
  check_refused({"verify", "square.obj", "--jobs", "paint"}, 64, folder, "paint");
  check_refused({"verify", "square.obj", "--context", "glx"}, 64, folder, "glx");
  check_refused({"verify", "square.obj", "--threads", "0"}, 64, folder, "threads");
  check_refused({"info"}, 64, folder, "info:");
  check_refused({"info", "square.obj", "extra"}, 64, folder, "extra");
}

TEST_CASE("absurd sizes: 64") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  for (const char* size : {"0", "-5", "1000000", "100000x100000", "99999999999999999999", "12x", "wide"}) {
    check_refused({"render", "square.obj", std::string("--size=") + size, "-o", "a.png"}, 64, folder, "--size");
    check_refused({"verify", "square.obj", std::string("--size=") + size}, 64, folder, "--size");
  }
}

TEST_CASE("bad models: 4") {
  const ScratchFolder folder;
  const std::vector<std::pair<std::string, std::string>> bad{
      {"nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
      {"infinite.obj", "v 1e999 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
      {"range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"},
      {"negative.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n"},
      {"no_faces.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"},
      {"empty.obj", ""},
      {"words.obj", "v a b c\n"},
      {"truncated.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 1000\nproperty float x\nproperty float y\nproperty float z\nelement face "
       "1\nproperty list uchar int vertex_indices\nend_header\nxx"},
      {"huge.ply",
       "ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty "
       "list uchar int vertex_indices\nend_header\n0 0 0\n"},
      {"corrupt.glb", "glTF\x02"},
      {"corrupt.gltf", "{\"asset\":"},
      {"unknown.xyz", "0 0 0"},
  };
  for (const auto& [name, content] : bad) {
    folder.file(name, content);
    check_refused({"render", name, "-o", "a.png"}, 4, folder, name);
    check_refused({"verify", name, "--report", "report"}, 4, folder, name);
    check_refused({"info", name}, 4, folder, name);
  }
  check_refused({"render", "missing.obj", "-o", "a.png"}, 4, folder, "missing.obj");
  check_refused({"verify", "missing.obj"}, 4, folder, "missing.obj");
  check_refused({"info", "missing.obj"}, 4, folder, "missing.obj");
  std::filesystem::create_directory(folder.path() / "folder.obj");
  check_refused({"info", "folder.obj"}, 4, folder, "folder.obj");
  check_refused({"info", "line\nbreak.obj"}, 4, folder, "break.obj");
}

TEST_CASE("bad textures and views: 4") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  folder.file("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.file("broken.png", "\x89PNG\r\n\x1a\n....");
  folder.file("text.json", "hello");
  folder.file("short.json", R"({"schema":"etalon/view/1","eye":[0,0]})");
  folder.file("same.json",
              R"({"schema":"etalon/view/1","eye":[0,0,0],"target":[0,0,0],"up":[0,1,0],"tan_half_fov_y":0.5,"near":0.1,"far":10})");
  folder.file("other.json", R"({"schema":"etalon/view/2"})");
  check_refused({"render", "square.obj", "--texture", "broken.png", "-o", "a.png"}, 4, folder, "broken.png");
  check_refused({"render", "square.obj", "--texture", "missing.png", "-o", "a.png"}, 4, folder, "missing.png");
  check_refused({"render", "plain.obj", "--texture", "broken.png", "-o", "a.png"}, 4, folder, "plain.obj");
  check_refused({"info", "broken.png"}, 4, folder, "broken.png");
  check_refused({"render", "square.obj", "--view", "text.json", "-o", "a.png"}, 4, folder, "text.json");
  check_refused({"render", "square.obj", "--view", "short.json", "-o", "a.png"}, 4, folder, "eye");
  check_refused({"render", "square.obj", "--view", "same.json", "-o", "a.png"}, 4, folder, "same.json: view: eye");
  check_refused({"verify", "square.obj", "--view", "same.json"}, 4, folder, "same.json: view: eye");
  const std::string rest = R"("eye":[0,0,4],"target":[0,0,0],"up":[0,1,0],"tan_half_fov_y":0.5,"near":0.5,"far":10})";
  for (const char* size : {R"("width":0,"height":5)", R"("width":12289,"height":5)", R"("width":5)", R"("width":5,"height":2.5)",
                           R"("width":5,"height":"5")", R"("width":5,"height":-5)", R"("width":99999999999999999999,"height":5)"}) {
    CAPTURE(size);
    folder.file("size.json", std::string(R"({"schema":"etalon/view/1",)") + size + "," + rest);
    check_refused({"render", "square.obj", "--view", "size.json", "-o", "a.png"}, 4, folder, "size.json: '");
    check_refused({"verify", "square.obj", "--view", "size.json", "--size", "16"}, 4, folder, "from 1 to 12288");
  }
  check_refused({"render", "square.obj", "--view", "other.json", "-o", "a.png"}, 4, folder, "etalon/view/1");
}

TEST_CASE("outputs that cannot be written: 4, and what was there is untouched") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  folder.file("a_file", "kept");
  check_refused({"render", "square.obj", "-o", "no/such/folder/a.png"}, 4, folder, "no/such/folder");
  check_refused({"make", "swirl", "-o", "no/such/folder/a.obj"}, 4, folder, "no/such/folder");
  check_refused({"info", "square.obj", "--json", "no/such/folder/a.json"}, 4, folder, "no/such/folder");
  check_refused({"make", "swirl", "-o", "a.obj", "--json", "no/such/folder/a.json"}, 4, folder, "no/such/folder");
  check_refused({"verify", "square.obj", "--report", "new", "--json", "new/deeper/a.json"}, 4, folder, "new/deeper");
  check_refused({"verify", "square.obj", "--report", "a_file/report"}, 4, folder, "a_file");
  check_refused({"verify", "square.obj", "--report", "a_file"}, 4, folder, "a_file");
  check_refused({"render", "square.obj", "-o", "."}, 64, folder, ".png or .exr");
  CHECK(read_text(folder.path() / "a_file") == "kept");
}

TEST_CASE("a folder without write permission: 4") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  // root may write anywhere, so root's runs go on as nobody, in a folder of root's; others lock their own.
  std::filesystem::permissions(folder.path(), std::filesystem::perms(geteuid() == 0 ? 0755 : 0555));
  const CommandOptions nobody{.as_nobody = true};
  CommandOptions probe = nobody;
  probe.folder = folder.path();
  if (run_etalon({"--version"}, probe).exit_code != 0) {
    report_skip("a folder without write permission", "user nobody cannot reach the program");
    return;
  }
  check_refused({"verify", "square.obj", "--report", "report"}, 4, folder, "ermission denied", nobody);
  check_refused({"render", "square.obj", "-o", "a.png"}, 4, folder, "ermission denied", nobody);
}

TEST_CASE("a full disk: 4, no temporary file stays, the old file does") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  folder.file("old.png", "the old picture");
  const CommandOptions full{.file_size_limit_bytes = 100};
  check_refused({"render", "square.obj", "--size", "256", "-o", "old.png", "--quiet"}, 4, folder, "old.png", full);
  CHECK(read_text(folder.path() / "old.png") == "the old picture");
  check_refused({"make", "swirl", "--faces", "200", "--texture-size", "64", "-o", "new.obj", "--quiet"}, 4, folder, "new", full);
  check_refused({"info", "square.obj", "--json", "new.json", "--quiet"}, 4, folder, "new.json", full);
}

TEST_CASE("a full standard output: 4") {
  const ScratchFolder folder;
  folder.file("square.obj", square_obj());
  const CommandOptions full{.stdout_path = "/dev/full"};
  check_refused({"info", "square.obj"}, 4, folder, "standard output", full);
  check_refused({"info", "square.obj", "--quiet", "--json", "-"}, 4, folder, "standard output", full);
  check_refused({"render", "square.obj", "--size", "16", "-o", "-", "--quiet"}, 4, folder, "standard output", full);
}
