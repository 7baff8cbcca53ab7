// libFuzzer on glTF: containers (.glb) and plain JSON, buffers inside or as data URIs.
#include "core/io/mesh_formats.h"
#include "tests/fuzz/mesh_target.h"

using namespace etalon;
using namespace etalon::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  is_read("fuzz.glb:", [&] { require_valid(io::read_gltf("fuzz.glb", file_bytes(bytes_of(data, size)))); });
  return 0;
}
