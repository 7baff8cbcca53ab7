// CPU renderer against llvmpipe on random scenes: nothing unexplained, coverage identical. ETALON_FULL=1 compares 10^9 texels.
#include "tests/validation/cross_check.h"

#include <doctest/doctest.h>

#include "raster/cpu_renderer.h"
#include "tests/validation/llvmpipe.h"

namespace etalon::test {
namespace {

TEST_CASE("random scenes: every difference between the CPU and llvmpipe is explained") {
  gpu::GlRenderer* gl = llvmpipe_or_skip("cross check");
  if (gl == nullptr) return;
  CrossCheckOptions options;
  options.texels = 20'000'000;  // etalon_crosscheck goes on to 10^9 in the full suite
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

TEST_CASE("a tie of depth with a triangle whose own values are unbounded is unbounded, not unexplained") {
  gpu::GlRenderer* gl = llvmpipe_or_skip("cross check of seed 3998");
  if (gl == nullptr) return;
  raster::CpuRenderer cpu;
  const CrossCheckTotals totals = cross_check(cpu, *gl, validation::llvmpipe_model(), {.first_seed = 3998, .texels = 1});
  CHECK(totals.total[validation::TexelClass::unexplained] == 0);
  CHECK(totals.total[validation::TexelClass::unbounded] > 0);
}

}  // namespace
}  // namespace etalon::test
