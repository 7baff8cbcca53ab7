// libFuzzer on descriptions of devices (`etalon/probe/1`).
#include <cmath>

#include "tests/fuzz/fuzz_target.h"
#include "validation/probe/probe_document.h"

using namespace etalon;
using namespace etalon::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  put_file("fuzz-probe.json", bytes_of(data, size));
  is_read("fuzz-probe.json: ", [&] {
    const validation::ProbeRecord probe = validation::read_probe("fuzz-probe.json");
    require(probe.findings.interpolation.samples > 0, "samples");
    require(std::isfinite(probe.findings.interpolation.affine) && std::isfinite(probe.findings.interpolation.perspective), "finite errors");
    const nlohmann::ordered_json again = validation::probe_document(probe, {});
    (void)again.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    (void)validation::probe_lines(probe.findings);
  });
  return 0;
}
