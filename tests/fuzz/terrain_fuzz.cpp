// libFuzzer on terrain streams: as the bytes are, and with the header's checksum made right.
#include <string>
#include <vector>

#include "core/base/sha256.h"
#include "core/terrain/terrain_stream.h"
#include "tests/fuzz/fuzz_target.h"

using namespace etalon;
using namespace etalon::test;

namespace {

void read(std::span<const std::byte> bytes) {
  is_read("terrain stream: ", [&] {
    const terrain::DecodedTerrain decoded = terrain::decode_terrain(bytes, {.max_bits = 6});
    terrain::validate(decoded.field);
    require(decoded.bytes_used <= bytes.size(), "no more bytes than there are");
    require(decoded.levels.count() >= 1 && decoded.levels.count() <= decoded.levels_in_whole, "a level, and no more than the header says");
    const Mesh mesh = terrain::level_mesh(decoded.field, decoded.levels, decoded.levels.count() - 1);
    require(mesh.vertex_count() == decoded.levels.vertex_counts.back(), "a mesh of the level's vertices");
  });
}

void repair(std::vector<std::byte>& stream) {
  const std::size_t end = stream.size() > 5 && (stream[5] & std::byte{1}) != std::byte{0} ? 149 : 49;
  if (stream.size() < end + 4) return;
  const std::string digits = sha256_hex(std::span<const std::byte>(stream).first(end)).substr(0, 8);
  const unsigned long check = std::stoul(digits, nullptr, 16);
  for (std::size_t i = 0; i < 4; ++i) stream[end + i] = static_cast<std::byte>((check >> (8 * i)) & 0xFF);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return read_and_read_repaired(
      data, size, [](std::span<const std::byte> bytes) { read(bytes); }, repair);
}
