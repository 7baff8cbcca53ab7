// libFuzzer on waivers (`etalon/waivers/1`).
#include "tests/fuzz/fuzz_target.h"
#include "validation/diff/waivers.h"

using namespace etalon;
using namespace etalon::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  put_file("fuzz-waivers.json", bytes_of(data, size));
  is_read("fuzz-waivers.json: ", [&] {
    for (const validation::Waiver& waiver : validation::read_waivers("fuzz-waivers.json"))
      require(!waiver.pair.empty() && waiver.texels > 0, "waivers of something");
  });
  return 0;
}
