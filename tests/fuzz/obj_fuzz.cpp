// libFuzzer on OBJ and MTL: the bytes up to the first zero byte are the model, those behind it its material library "fuzz.mtl".
#include "core/io/mesh_formats.h"
#include "tests/fuzz/mesh_target.h"

using namespace etalon;
using namespace etalon::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> all = bytes_of(data, size);
  const auto zero = std::find(all.begin(), all.end(), std::byte{0});
  const std::span<const std::byte> model(all.begin(), zero);
  if (zero != all.end()) {
    put_file("fuzz.mtl", std::span(zero + 1, all.end()));
  } else {
    std::filesystem::remove("fuzz.mtl");
  }
  is_read("fuzz", [&] { require_valid(io::read_obj("fuzz.obj", file_bytes(model))); });
  return 0;
}
