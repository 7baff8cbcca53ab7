// libFuzzer on joint streams (.ejt): as the bytes are, and with the checksums of header and segments made right.
#include <vector>

#include "core/joint/joint_stream.h"
#include "core/progressive/epm_format.h"
#include "tests/fuzz/fuzz_target.h"

using namespace etalon;
using namespace etalon::test;

namespace {

void read(std::span<const std::byte> bytes) {
  // The streams inside name themselves.
  is_read("", [&] {
    const joint::DecodedJoint decoded = joint::decode_joint(bytes, {.max_texels = 1 << 12});
    require(decoded.bytes_used <= bytes.size(), "no more bytes than there are");
    require(!decoded.texture.empty(), "a texture");
    require(decoded.pair.mesh < decoded.mesh_levels && decoded.pair.texture < decoded.texture_levels, "a pair of levels that there are");
    require(terrain::level_mesh(decoded.terrain.field, decoded.terrain.levels, decoded.pair.mesh).face_count() >= 2, "a mesh");
  });
}

void put_crc(std::vector<std::byte>& bytes, std::size_t at, std::size_t begin, std::size_t length) {
  const std::uint32_t crc = progressive::crc32(std::span<const std::byte>(bytes).subspan(begin, length));
  for (std::size_t k = 0; k < 4; ++k) bytes[at + k] = static_cast<std::byte>((crc >> (8 * k)) & 0xFF);
}

void repair(std::vector<std::byte>& bytes) {
  if (bytes.size() < joint::kJointHeaderBytes) return;
  put_crc(bytes, 16, 0, 16);
  for (std::size_t at = joint::kJointHeaderBytes; at + joint::kSegmentHeadBytes <= bytes.size();) {
    std::size_t length = 0;
    for (std::size_t k = 4; k-- > 0;) length = length << 8 | std::to_integer<std::size_t>(bytes[at + 1 + k]);
    if (length > bytes.size() - at - joint::kSegmentHeadBytes) return;
    put_crc(bytes, at + 5, at + joint::kSegmentHeadBytes, length);
    at += joint::kSegmentHeadBytes + length;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return read_and_read_repaired(
      data, size, [](std::span<const std::byte> bytes) { read(bytes); }, repair);
}
