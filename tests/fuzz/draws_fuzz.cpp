// libFuzzer on FILE.draws: any bytes are refused by an InputError in one line that names the file, or are a list that is valid.
#include "core/io/draws_file.h"
#include "tests/fuzz/fuzz_target.h"

using namespace etalon;
using namespace etalon::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  is_read("fuzz.draws: ", [&] {
    const auto any_image = [](const auto&, const auto&) { return Image(2, 3, kRgba8); };
    const io::DrawsFile file = io::decode_draws(bytes_of(data, size), "fuzz.draws", "", any_image);
    validate(file.list, file.frame);
  });
  return 0;
}
