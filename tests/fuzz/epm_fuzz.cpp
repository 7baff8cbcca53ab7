// libFuzzer on progressive meshes (.epm) and their cells: as the bytes are, and with the checksums of the chunks made right.
#include <cstring>
#include <vector>

#include "core/adapt/cell_chunks.h"
#include "core/progressive/epm_format.h"
#include "tests/fuzz/fuzz_target.h"

using namespace etalon;
using namespace etalon::test;

namespace {

void read(std::span<const std::byte> bytes) {
  is_read("", [&] {
    progressive::EpmContent content = progressive::decode_epm(bytes);
    for (const std::size_t level : {content.mesh.split_count(), content.mesh.split_count() / 2, std::size_t{0}}) {
      content.mesh.go_to(level);
      require(content.mesh.violation().empty(), "a mesh at every level");
    }
    const std::string again = progressive::encode_epm(content.mesh.data(), content.extras);
    require(progressive::decode_epm(std::as_bytes(std::span(again.data(), again.size()))).mesh.data() == content.mesh.data(),
            "what is written again is the same mesh");
    (void)adapt::decode_cells(content);
  });
}

void repair(std::vector<std::byte>& file) {
  for (std::size_t at = 8; at + 16 <= file.size();) {
    std::uint64_t size = 0;
    std::memcpy(&size, file.data() + at + 8, 8);
    if (size > file.size() - at - 16) return;
    const std::span<const std::byte> all(file);
    const std::uint32_t crc =
        progressive::crc32(all.subspan(at + 8, 8 + static_cast<std::size_t>(size)), progressive::crc32(all.subspan(at, 4)));
    std::memcpy(file.data() + at + 4, &crc, 4);
    at += 16 + static_cast<std::size_t>(size);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return read_and_read_repaired(
      data, size, [](std::span<const std::byte> bytes) { read(bytes); }, repair);
}
