#include "core/progressive/epm_format.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "tests/simplify/sample_meshes.h"

using namespace etalon;
using namespace etalon::progressive;
using namespace etalon::test;

namespace {

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text.data(), text.size())); }

std::string file_of(const Mesh& mesh) { return encode_epm(make_progressive(mesh, {.target_faces = 0}).data); }

std::string message_of(const std::string& file) {
  try {
    (void)decode_epm(bytes_of(file));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

Mesh coloured_seams() {
  Mesh mesh = seamed_grid(6, 0.2f, 4);
  for (const Vec3f& p : mesh.positions) mesh.colors.push_back({p.x, p.y, p.z, 0.5f});
  for (std::size_t f = 0; f < mesh.face_count(); ++f) mesh.face_materials.push_back(f % 12 < 6 ? 3 : 0);
  return mesh;
}

/// Where the chunks of a file start.
std::vector<std::size_t> chunks_of(const std::string& file) {
  std::vector<std::size_t> starts;
  for (std::size_t at = 8; at + 16 <= file.size();) {
    starts.push_back(at);
    std::uint64_t size = 0;
    std::memcpy(&size, file.data() + at + 8, 8);
    at += 16 + size;
  }
  return starts;
}

/// Makes the checksum of the chunk at `at` right again, so that what lies behind it is reached.
void mend_checksum(std::string& file, std::size_t at) {
  std::uint64_t size = 0;
  std::memcpy(&size, file.data() + at + 8, 8);
  const auto all = bytes_of(file);
  if (size > file.size() - at - 16) return;
  const std::uint32_t crc = crc32(all.subspan(at + 8, 8 + size), crc32(all.subspan(at, 4)));
  std::memcpy(file.data() + at + 4, &crc, 4);
}

/// Refused, or a mesh at every level.
void survive(const std::string& file) {
  try {
    EpmContent content = decode_epm(bytes_of(file));
    content.mesh.go_to(content.mesh.split_count());
    (void)content.mesh.mesh();
    content.mesh.go_to(content.mesh.split_count() / 2);
    (void)content.mesh.mesh();
  } catch (const InputError&) {
  }
}

}  // namespace

TEST_CASE("the checksum is CRC-32") {
  CHECK(crc32(bytes_of("123456789")) == 0xCBF43926u);  // the check value of ISO 3309
  CHECK(crc32(bytes_of("6789"), crc32(bytes_of("12345"))) == 0xCBF43926u);
}

TEST_CASE("data go through the file unchanged, and equal data are equal bytes") {
  std::vector<NamedMesh> meshes = sample_meshes();
  meshes.push_back({"colours, seams and materials", coloured_seams()});
  for (const NamedMesh& sample : meshes) {
    CAPTURE(sample.name);
    const ProgressiveData data = make_progressive(sample.mesh, {.target_faces = 0}).data;
    const std::string file = encode_epm(data);
    const EpmContent content = decode_epm(bytes_of(file));
    CHECK(content.complete);
    CHECK(content.splits_in_whole == data.splits.size());
    CHECK(content.mesh.data() == data);
    CHECK(encode_epm(content.mesh.data()) == file);
  }
}

TEST_CASE("every prefix is refused, or holds the splits of its whole blocks") {
  const std::string file = file_of(bumpy_grid(12, 0.3f, 2));
  const EpmContent whole = decode_epm(bytes_of(file));
  const std::vector<std::size_t> chunks = chunks_of(file);
  REQUIRE(chunks.size() >= 5);  // head, base, at least two blocks, end
  std::size_t refused = 0;
  for (std::size_t size = 0; size < file.size(); ++size) {
    const std::string prefix = file.substr(0, size);
    if (size < chunks[2]) {
      CHECK(message_of(prefix) != "");
      ++refused;
      continue;
    }
    if (size % 97 != 0 && size != chunks[3] && size != chunks[3] - 1) continue;
    const EpmContent content = decode_epm(bytes_of(prefix));
    CHECK_FALSE(content.complete);
    CHECK(content.splits_in_whole == whole.splits_in_whole);
    std::size_t blocks = 0;
    while (blocks + 3 < chunks.size() && chunks[blocks + 3] <= size) ++blocks;
    CHECK(content.mesh.split_count() == std::min(blocks * kEpmBlockSplits, whole.splits_in_whole));
  }
  CHECK(refused == chunks[2]);
}

TEST_CASE("a prefix is the coarse end of the whole") {
  const std::string file = file_of(bumpy_grid(12, 0.3f, 2));
  EpmContent whole = decode_epm(bytes_of(file)), part = decode_epm(bytes_of(file.substr(0, chunks_of(file)[3])));
  REQUIRE(part.mesh.split_count() == kEpmBlockSplits);
  part.mesh.go_to(kEpmBlockSplits);
  whole.mesh.go_to(kEpmBlockSplits);
  CHECK(part.mesh.mesh() == whole.mesh.mesh());
}

TEST_CASE("what is wrong is said, with its place") {
  const std::string file = file_of(bumpy_grid(6, 0.3f, 2));
  const std::vector<std::size_t> chunks = chunks_of(file);
  const auto after = [&](std::size_t chunk, std::size_t offset, char value) {
    std::string damaged = file;
    damaged[chunks[chunk] + offset] = value;
    mend_checksum(damaged, chunks[chunk]);
    return message_of(damaged);
  };
  CHECK(message_of("") == "byte 0: expected the signature 'etalonPM' of a progressive mesh");
  CHECK(message_of("etalonXX" + file.substr(8)).find("signature") != std::string::npos);
  CHECK(message_of(file.substr(0, 20)) == "byte 8: the file ends inside its HEAD chunk");
  CHECK(after(0, 16, 2) == "version: expected 1, got 2");
  CHECK(after(0, 20, 9) == "flags: expected at most 7, got 9");
  CHECK(after(0, 0, 'B').find("byte 8: expected the HEAD chunk") == 0);
  CHECK(after(1, 0, 'X').find("expected the BASE chunk") != std::string::npos);
  CHECK(after(2, 0, 'X').find("got an unknown one") != std::string::npos);
  CHECK(after(2, 0, 'x').find("splits: expected") == 0);  // a small letter may be passed over, and then its splits are missing
  CHECK(after(1, 16, 100).find("byte ") == 0);
  CHECK(message_of(file + "!").find("expected the end of the file, got 1 more bytes") != std::string::npos);
  std::string flipped = file;
  flipped[chunks[2] + 30] = static_cast<char>(flipped[chunks[2] + 30] ^ 1);
  CHECK(message_of(flipped).find("checksum: expected") != std::string::npos);
}

TEST_CASE("mutants are refused or are meshes; half of them with checksums made right") {
  const char* full = std::getenv("ETALON_FULL");
  const std::vector<std::string> files{file_of(bumpy_grid(5, 0.3f, 2)), file_of(coloured_seams()), file_of(bumpy_sphere(3, 0.2f, 1))};
  Rng rng(8);
  for (int i = 0; i < (full != nullptr ? 1'000'000 : 20'000); ++i) {
    std::string file = files[rng.below(files.size())];
    const std::vector<std::size_t> chunks = chunks_of(file);
    for (std::uint64_t n = 1 + rng.below(3); n-- > 0;) {
      const std::size_t at = rng.below(file.size());
      file[at] = static_cast<char>(rng.coin() ? file[at] ^ (1 << rng.below(8)) : static_cast<char>(rng.below(256)));
    }
    if (rng.coin())
      for (const std::size_t chunk : chunks) mend_checksum(file, chunk);
    survive(file);
  }
}
