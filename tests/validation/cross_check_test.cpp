// CPU renderer against llvmpipe on random scenes: nothing unexplained, coverage identical. ETALON_FULL=1 compares 10^9 texels.
#include "tests/validation/cross_check.h"

#include <doctest/doctest.h>

#include <cstdlib>

#include "raster/cpu_renderer.h"
#include "tests/validation/llvmpipe.h"

namespace etalon::test {
namespace {

TEST_CASE("random scenes: every difference between the CPU and llvmpipe is explained") {
  gpu::GlRenderer* gl = llvmpipe_or_skip("cross check");
  if (gl == nullptr) return;
  const char* full = std::getenv("ETALON_FULL");
  CrossCheckOptions options;
  options.texels = full != nullptr && full[0] == '1' ? 1'000'000'000 : 20'000'000;
  raster::CpuRenderer cpu;
  const CrossCheckTotals totals = cross_check(cpu, *gl, validation::llvmpipe_model(), options);
  std::printf("%s", format_totals(totals).c_str());
  CHECK(totals.total[validation::TexelClass::unexplained] == 0);
  CHECK(totals.failures.empty());
  // The check has something to explain, and does not explain it away.
  CHECK(totals.total[validation::TexelClass::rounding] > totals.total.total() / 50);
  CHECK(totals.total[validation::TexelClass::tie] > 1000);
  CHECK(totals.total[validation::TexelClass::unbounded] < totals.total.total() / 500);
}

}  // namespace
}  // namespace etalon::test
