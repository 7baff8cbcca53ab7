// etalon_crosscheck [--context osmesa|egl] [--shader exact] [--nearest] [TEXELS [FIRST_SEED [LARGEST]]]: the CPU renderer against OpenGL on random
// scenes of at most LARGEST texels a side, until TEXELS texels are compared; with the exact shader every byte that differs is unexplained.
// A long run is resumed with the seed the last table ends before. Exit 0: nothing unexplained; 2: something is; 1: no OpenGL here; 64: usage.
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "core/base/error.h"
#include "gpu/gl_renderer.h"
#include "raster/cpu_renderer.h"
#include "tests/validation/cross_check.h"

int main(int argc, char** argv) {
  using namespace etalon;
  test::CrossCheckOptions options;
  gpu::ContextOptions context{.driver = gpu::Driver::llvmpipe};
  for (; argc > 1 && std::string_view(argv[1]).starts_with("--"); --argc, ++argv) {
    const std::string_view option = argv[1], value = argc > 2 ? argv[2] : "";
    if (option == "--nearest") {
      options.nearest = true;
      continue;
    }
    if (option == "--shader" && value == "exact") {
      options.exact = true;
    } else if (option == "--context" && (value == "osmesa" || value == "egl")) {
      context.platform = value == "egl" ? gpu::Platform::egl : gpu::Platform::osmesa;
    } else {
      std::fprintf(stderr, "etalon_crosscheck: error: expected --context osmesa or egl, --shader exact or --nearest, got %s\n", argv[1]);
      return 64;
    }
    --argc, ++argv;
  }
  if (argc > 1) options.texels = std::strtoull(argv[1], nullptr, 10);
  if (argc > 2) options.first_seed = std::strtoull(argv[2], nullptr, 10);
  if (argc > 3) options.largest = std::atoi(argv[3]);
  options.progress = [next = std::uint64_t{0}, &options](const test::CrossCheckTotals& totals) mutable {
    if (totals.total.total() < next) return;
    next += options.texels / 10 + 1;
    std::fputs(test::format_totals(totals).c_str(), stdout);
    std::fflush(stdout);
  };
  try {
    raster::CpuRenderer cpu;
    gpu::GlRenderer gl(context, options.exact ? gpu::ShaderMode::exact : gpu::ShaderMode::native);
    if (!gl.name().starts_with("llvmpipe") && !options.exact)
      throw UnavailableError("expected llvmpipe, whose bounds are known; got " + gl.name());
    const validation::DeviceModel model = options.exact ? validation::contract_model() : validation::llvmpipe_model();
    std::printf("%s against %s\n", cpu.name().c_str(), gl.name().c_str());
    const test::CrossCheckTotals totals = test::cross_check(cpu, gl, model, options);
    std::fputs(test::format_totals(totals).c_str(), stdout);
    return totals.total[validation::TexelClass::unexplained] == 0 ? 0 : 2;
  } catch (const UnavailableError& error) {
    std::fprintf(stderr, "etalon_crosscheck: %s\n", error.what());
    return 1;
  } catch (const Error& error) {
    std::fprintf(stderr, "etalon_crosscheck: error: %s\n", error.what());
    return 4;
  }
}
