// Streams that a release has written decode to the same numbers for ever: data/streams/vN, each with its goldens.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/sha256.h"
#include "core/io/inputs.h"
#include "tests/streams/decoded_stream.h"

using namespace etalon;

namespace {

namespace fs = std::filesystem;
const fs::path kFolder = fs::path(ETALON_SOURCE) / "data" / "streams" / "v1";

struct Golden {
  std::string name, sha256, decoded, prefix_decoded;
  std::size_t size_bytes = 0, prefix_bytes = 0;
};

std::vector<Golden> goldens() {
  std::ifstream file(kFolder / "GOLDENS");
  std::vector<Golden> result;
  for (Golden g; file >> g.name >> g.size_bytes >> g.sha256 >> g.decoded >> g.prefix_bytes >> g.prefix_decoded;) result.push_back(g);
  return result;
}

}  // namespace

TEST_CASE("frozen streams: each file is there as it was written, and decodes to its golden; so does two thirds of it") {
  REQUIRE(goldens().size() == 8);
  for (const Golden& golden : goldens()) {
    CAPTURE(golden.name);
    const io::FileBytes file = io::read_file(kFolder / golden.name);
    REQUIRE(file.bytes().size() == golden.size_bytes);
    CHECK(sha256_hex(file.bytes()) == golden.sha256);
    CHECK(test::decoded_sha256(kFolder / golden.name, file.bytes()) == golden.decoded);
    CHECK(test::decoded_sha256(kFolder / golden.name, file.bytes().first(golden.prefix_bytes)) == golden.prefix_decoded);
  }
}

TEST_CASE("frozen streams: no file without a golden, but the images of drawings") {
  std::set<std::string> known = {"GOLDENS", "scene.0.png"};
  for (const Golden& golden : goldens()) known.insert(golden.name);
  for (const auto& entry : fs::directory_iterator(kFolder)) CHECK_MESSAGE(known.contains(entry.path().filename().string()), entry.path());
}

TEST_CASE("frozen streams: the hash sees every byte that decoding depends on") {
  // A texture stream carries no checksum over its body: a changed byte is another picture, and another hash.
  const fs::path path = kFolder / "stripes_5_3.etws";
  const io::FileBytes file = io::read_file(path);
  std::vector<std::byte> changed(file.bytes().begin(), file.bytes().end());
  changed[changed.size() / 2] ^= std::byte{1};
  CHECK(test::decoded_sha256(path, changed) != test::decoded_sha256(path, file.bytes()));
  CHECK_THROWS_AS((void)test::decoded_sha256("stream.unknown", file.bytes()), InputError);
}
