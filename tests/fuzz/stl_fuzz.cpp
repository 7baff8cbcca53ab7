// libFuzzer on STL, ascii and binary.
#include "core/io/mesh_formats.h"
#include "tests/fuzz/mesh_target.h"

using namespace etalon;
using namespace etalon::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  is_read("fuzz.stl:", [&] { require_valid(io::read_stl("fuzz.stl", file_bytes(bytes_of(data, size)))); });
  return 0;
}
