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

/// True where the file is refused; else it must be a consistent mesh at its ends and in between.
bool refused(const std::string& file) {
  try {
    EpmContent content = decode_epm(bytes_of(file));
    const std::size_t top = content.mesh.split_count();
    for (const std::size_t level : {top, top / 2, std::size_t{0}}) {
      content.mesh.go_to(level);
      REQUIRE(content.mesh.violation() == "");
      REQUIRE(content.mesh.mesh().face_count() == content.mesh.face_count());
    }
    return false;
  } catch (const InputError&) {
    return true;
  }
}

/// A chunk with a right checksum.
std::string chunk_of(const std::string& tag, const std::string& payload) {
  const std::uint64_t size = payload.size();
  std::string chunk = tag + std::string(12, '\0') + payload;
  std::memcpy(chunk.data() + 8, &size, 8);
  mend_checksum(chunk, 0);
  return chunk;
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

TEST_CASE("moves of full-edge collapses go through the file; a file without them is as it was") {
  for (const bool coloured : {false, true}) {
    const Mesh mesh = coloured ? coloured_seams() : bumpy_sphere(4, 0.2f, 1);
    const ProgressiveData data = make_progressive(mesh, {.collapse = simplify::CollapseKind::full, .target_faces = 0}).data;
    REQUIRE(data.moves.size() > 3);
    const std::string file = encode_epm(data);
    CHECK(decode_epm(bytes_of(file)).mesh.data() == data);
    CHECK(encode_epm(decode_epm(bytes_of(file)).mesh.data()) == file);
    CHECK((file[28] & 8) == 8);  // flags: behind the signature, the chunk's head and the version
    CHECK((file_of(mesh)[28] & 8) == 0);
    const std::size_t block = chunks_of(file)[2];
    std::uint64_t size = 0;
    std::memcpy(&size, file.data() + block + 8, 8);
    bool refused_move = false;
    for (std::size_t at = block + 16; at < block + 16 + size && !refused_move; ++at) {
      std::string damaged_here = file;
      damaged_here[at] = 8;
      mend_checksum(damaged_here, block);
      refused_move = message_of(damaged_here).find("move: expected 0, or 1 and perhaps 2 and 4, got 8") != std::string::npos;
    }
    CHECK(refused_move);
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
  CHECK(after(0, 20, 16) == "flags: expected at most 15, got 16");
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

TEST_CASE("names of materials go through the file; a face without a name among them is refused") {
  ProgressiveData data = make_progressive(coloured_seams(), {.target_faces = 0}).data;
  data.material_names = {"skin", "", "wood \xC3\xA9", "eye"};
  const std::string file = encode_epm(data);
  CHECK(decode_epm(bytes_of(file)).mesh.data() == data);
  CHECK(decode_epm(bytes_of(file.substr(0, chunks_of(file)[3]))).mesh.data().material_names == data.material_names);
  data.material_names.resize(2);
  CHECK(message_of(encode_epm(data)).find("material: expected below 2, got 3") != std::string::npos);
  data.material_names = {"a", "b", "c", "two\nlines"};
  CHECK(message_of(encode_epm(data)) == "material 3: expected a name without control characters");

  const std::string plain = file_of(bumpy_grid(4, 0.3f, 2));
  const std::size_t behind_base = chunks_of(plain)[2];
  const auto with = [&](const std::string& chunks) {
    return message_of(plain.substr(0, behind_base) + chunks + plain.substr(behind_base));
  };
  const std::string one("\1\0\0\0\1\0\0\0a", 9);
  CHECK(with(chunk_of("mtls", one)) == "");
  CHECK(with(chunk_of("mtls", one) + chunk_of("mtls", one)).find("expected the names of materials once") != std::string::npos);
  CHECK(with(chunk_of("mtls", std::string(4, '\0'))).find("expected at least one name") != std::string::npos);
  CHECK(with(chunk_of("mtls", one + "x")).find("expected the end of the chunk") != std::string::npos);
  CHECK(with(chunk_of("mtls", std::string("\1\0\0\0\2\0\0\0a", 9))).find("expected 2 more bytes, got 1") != std::string::npos);
}

TEST_CASE("cells, a base map and unknown optional chunks are carried along; their checksums count") {
  const ProgressiveData data = make_progressive(bumpy_grid(12, 0.3f, 2), {.target_faces = 0}).data;
  REQUIRE(data.splits.size() > kEpmBlockSplits);
  const std::vector<EpmExtra> extras{
      {"BMAP", 0, "map"}, {"note", 0, ""}, {"CELL", kEpmBlockSplits, std::string("\0\1cells", 7)}, {"CELL", data.splits.size(), "last"}};
  const std::string file = encode_epm(data, extras);
  const EpmContent content = decode_epm(bytes_of(file));
  CHECK(content.complete);
  CHECK(content.mesh.data() == data);
  CHECK(content.extras == extras);
  CHECK(encode_epm(content.mesh.data(), content.extras) == file);
  const std::vector<std::size_t> chunks = chunks_of(file);  // HEAD BASE BMAP note SPLT CELL SPLT …
  const EpmContent part = decode_epm(bytes_of(file.substr(0, chunks[6])));
  CHECK(part.extras == std::vector<EpmExtra>(extras.begin(), extras.begin() + 3));
  CHECK(part.mesh.split_count() == kEpmBlockSplits);
  for (const std::size_t chunk : {2, 3, 5}) {
    std::string damaged = file;
    damaged[chunks[chunk] + (chunk == 3 ? 8 : 16)] ^= 1;  // `note` is empty: its size
    CAPTURE(chunk);
    CHECK(message_of(damaged).find(chunk == 3 ? "" : "checksum: expected") != std::string::npos);
    CHECK(message_of(damaged) != "");
  }
  const auto message_with = [&](const std::vector<EpmExtra>& wrong) {
    try {
      (void)encode_epm(data, wrong);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const char* tag : {"HEAD", "DONE", "SPLT", "mtls", "NOTE", "no", "notes", "no e", ""})
    CHECK(message_with({{tag, 0, ""}}).find("extra chunk: expected CELL, BMAP or four letters, the first small") == 0);
  CHECK(message_with({{"CELL", 1, ""}}).find("extra chunk CELL: expected in order behind whole blocks of 64 splits, got 1") == 0);
  CHECK(message_with({{"CELL", 128, ""}, {"BMAP", 64, ""}}).find("extra chunk BMAP") == 0);
  CHECK(message_with({{"CELL", data.splits.size() + 64, ""}}).find("extra chunk CELL") == 0);
}

TEST_CASE("mutants are refused or are meshes; half of them with checksums made right") {
  const char* full = std::getenv("ETALON_FULL");
  ProgressiveData named = make_progressive(coloured_seams(), {.target_faces = 0}).data;
  named.material_names = {"a", "b", "c", "d"};
  const simplify::SimplifyOptions full_edge{.collapse = simplify::CollapseKind::full, .target_faces = 0};
  const std::vector<std::string> files{file_of(bumpy_grid(5, 0.3f, 2)),
                                       encode_epm(named, {{"BMAP", 0, "map"}, {"CELL", named.splits.size(), "cell"}}),
                                       file_of(bumpy_sphere(3, 0.2f, 1)), encode_epm(make_progressive(coloured_seams(), full_edge).data)};
  Rng rng(8);
  std::size_t mended = 0, mended_refused = 0, broken_taken = 0;
  const int count = full != nullptr && *full != '\0' ? 1'000'000 : 20'000;
  for (int i = 0; i < count; ++i) {
    const std::string& original = files[rng.below(files.size())];
    std::string file = original;
    const std::vector<std::size_t> chunks = chunks_of(file);
    for (std::uint64_t n = 1 + rng.below(3); n-- > 0;) {
      const std::size_t at = rng.below(file.size());
      file[at] = static_cast<char>(rng.coin() ? file[at] ^ (1 << rng.below(8)) : static_cast<char>(rng.below(256)));
    }
    const bool mend = rng.coin();
    if (mend)
      for (const std::size_t chunk : chunks) mend_checksum(file, chunk);
    const bool was_refused = refused(file);
    mended += mend ? 1 : 0;
    mended_refused += mend && was_refused ? 1 : 0;
    if (!mend && !was_refused && file != original && decode_epm(bytes_of(file)).complete) ++broken_taken;
  }
  // Both outcomes are met: mutants reach what lies behind the checksums. Without mending none passes as whole: a byte is nowhere but under a checksum
  // or in the signature, and up to three bytes that change within one chunk are more than 2^-32 likely to pass only if they are none.
  CHECK(mended_refused > mended / 10);
  CHECK(mended_refused < mended - mended / 10);
  CHECK(broken_taken == 0);
}
