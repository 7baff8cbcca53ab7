// libFuzzer on view files (`etalon/view/1`).
#include "cli/view_option.h"
#include "tests/fuzz/fuzz_target.h"

using namespace etalon;
using namespace etalon::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  put_file("fuzz-view.json", bytes_of(data, size));
  is_read("fuzz-view.json: ", [&] {
    const cli::ViewChoice view = cli::parse_view("fuzz-view.json");
    require(view.named.camera.has_value(), "a camera");
    (void)clip_from_object(*view.named.camera, 640, 480);
  });
  return 0;
}
