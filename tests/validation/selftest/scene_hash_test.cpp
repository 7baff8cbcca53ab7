#include <doctest/doctest.h>

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "core/base/error.h"
#include "core/base/sha256.h"
#include "raster/cpu_renderer.h"
#include "validation/selftest/scene_hash.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

std::string read(const std::string& path) {
  std::ifstream in(std::string(ETALON_SOURCE_DIR) + "/" + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string sha256_of(const std::string& text) { return sha256_hex(std::as_bytes(std::span(text.data(), text.size()))); }

// One family of one scene: a texel of one colour.
SceneFamily one_texel(const std::string& name, float red) {
  FixedScene scene{name, {}, {1, 1, 8, {}, {{TargetContent::color, {ChannelType::half, 1}, {red, 0, 0, 0}}}}};
  return {name, {scene}};
}

}  // namespace

TEST_CASE("the golden hashes compiled in are the file's, and the README prints the one hash") {
  const std::string file = read("data/golden/hash_scenes.sha256");
  CHECK(to_text(golden_scene_hashes()) == file);
  CHECK(golden_scene_hashes().families.size() == fixed_scenes().size());
  const std::string readme = read("README.md");
  CHECK(readme.find("\n" + golden_scene_hashes().all + "\n") != std::string::npos);
  std::size_t scenes = 0;
  for (const SceneFamily& family : fixed_scenes()) scenes += family.scenes.size();
  CHECK(readme.find(fmt::format("\n{},{:03} fixed scenes, ", scenes / 1000, scenes % 1000)) != std::string::npos);
}

TEST_CASE("the one hash is the hash of the lines below it") {
  const std::string file = read("data/golden/hash_scenes.sha256");
  const std::size_t end_of_first = file.find('\n') + 1;
  CHECK(sha256_of(file.substr(end_of_first)) == file.substr(0, 64));
}

TEST_CASE("bytes are hashed lowest first: by hand") {
  raster::CpuRenderer renderer;
  const SceneHashes hashes = hash_scenes({one_texel("a", 1), one_texel("b", 0)}, renderer);
  // 1 as half is 0x3c00.
  CHECK(hashes.families[0].sha256 == sha256_of(std::string("r half 1 1\n\x00\x3c", 13)));
  CHECK(hashes.families[1].sha256 == sha256_of(std::string("r half 1 1\n\x00\x00", 13)));
  CHECK(hashes.all == sha256_of(hashes.families[0].sha256 + "  a\n" + hashes.families[1].sha256 + "  b\n"));
  CHECK(parse_scene_hashes(to_text(hashes)) == hashes);
}

TEST_CASE("the first family that differs is named") {
  raster::CpuRenderer renderer;
  const SceneHashes hashes = hash_scenes({one_texel("a", 1), one_texel("b", 0)}, renderer);
  CHECK(hashes.first_difference(hashes).empty());
  CHECK(hashes.first_difference(hash_scenes({one_texel("a", 1), one_texel("b", 1)}, renderer)) == "b");
  CHECK(hashes.first_difference(hash_scenes({one_texel("a", 1)}, renderer)) == "b");
  CHECK(hash_scenes({one_texel("a", 1)}, renderer).first_difference(hashes) == "b");
}

TEST_CASE("a golden text that is none is refused") {
  const auto message = [](const std::string& text) -> std::string {
    try {
      (void)parse_scene_hashes(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string hash(64, 'a');
  CHECK(message("").find("expected a first line") != std::string::npos);
  CHECK(message(hash + "  something else\n" + hash + "  x\n").find("expected a first line") != std::string::npos);
  CHECK(message("short\n").find("line 1: expected 64 hex digits") != std::string::npos);
  CHECK(message(std::string(64, 'g') + "  x\n").find("line 1: expected 64 hex digits") != std::string::npos);
  std::string changed = to_text(golden_scene_hashes());
  char& digit = changed[changed.find('\n') + 1];
  digit = digit == '0' ? '1' : '0';
  CHECK(message(changed).find("the first line is not the hash of the others") != std::string::npos);
}
