#include "cli/gl_options.h"

#include "cli/usage_error.h"
#include "core/base/error.h"

#ifdef ETALON_HAVE_GPU
#include "gpu/gl_renderer.h"
#include "gpu/unchecked_renderer.h"
#endif

namespace etalon::cli {

void add_gl_options(CLI::App& verb, GlOptions& options) {
  verb.add_option("--context", options.context,
                  "Where the OpenGL context comes from: auto (OSMesa, else EGL), osmesa, egl (a GPU, else Mesa's software rasterizer)")
      ->type_name("KIND")
      ->check(CLI::IsMember({"auto", "osmesa", "egl"}));
  verb.add_option("--driver", options.driver, "Mesa's rasterizer: llvmpipe, softpipe, default")
      ->type_name("NAME")
      ->check(CLI::IsMember({"llvmpipe", "softpipe", "default"}));
  verb.add_option("--shader", options.shader,
                  "native: what an application would write (default); exact: the contract evaluated in the shader, same bytes")
      ->type_name("KIND")
      ->check(CLI::IsMember({"native", "exact"}));
}

#ifdef ETALON_HAVE_GPU

namespace {

gpu::Driver driver_of(const std::string& name) {
  if (name == "llvmpipe") return gpu::Driver::llvmpipe;
  if (name == "softpipe") return gpu::Driver::softpipe;
  return gpu::Driver::device_default;
}

gpu::Platform platform_of(const std::string& name) {
  if (name == "egl") return gpu::Platform::egl;
  if (name == "osmesa") return gpu::Platform::osmesa;
  return gpu::Platform::automatic;
}

// Bounds were derived for llvmpipe only; any other device gets their shape with room, and is not called proven.
validation::DeviceModel model_of(const gpu::DeviceInfo& device) {
  if (device.renderer.rfind("llvmpipe", 0) == 0) return validation::llvmpipe_model();
  return validation::measured_model(device.name(), 4, "llvmpipe's bounds times 4, not derived for this device");
}

gpu::ContextOptions context_options(const GlOptions& options, int threads) {
  return {.platform = platform_of(options.context),
          .driver = driver_of(options.driver),
          .threads = threads > 0 ? threads : -1,
          .library_path = ""};
}

void require_native(const GlOptions& options) {
  if (options.shader == "exact") throw UsageError("--shader exact: the values would be the shader's own; a probe measures the device's");
}

}  // namespace

OpenedDevice open_device(const GlOptions& options, int threads) {
  OpenedDevice opened;
  try {
    auto renderer = std::make_unique<gpu::GlRenderer>(context_options(options, threads),
                                                      options.shader == "exact" ? gpu::ShaderMode::exact : gpu::ShaderMode::native);
    // The exact shader owes the contract itself: no bound is lent to it.
    opened.model = options.shader == "exact" ? validation::contract_model() : model_of(renderer->device());
    opened.renderer = std::move(renderer);
  } catch (const UnavailableError& error) {
    opened.unavailable = error.what();
  }
  return opened;
}

OpenedProbeDevice open_probe_device(const GlOptions& options, int threads) {
  require_native(options);
  OpenedProbeDevice opened;
  try {
    auto renderer = std::make_unique<gpu::UncheckedRenderer>(context_options(options, threads));
    const gpu::DeviceInfo& device = renderer->device();
    opened.words = {device.name(), device.renderer, device.vendor, device.version, device.origin, device.subtexel_bits};
    opened.renderer = std::move(renderer);
  } catch (const UnavailableError& error) {
    opened.unavailable = error.what();
  }
  return opened;
}

#else

OpenedDevice open_device(const GlOptions&, int) {
  OpenedDevice opened;
  opened.unavailable = "this build has no OpenGL side (ETALON_GPU=OFF)";
  return opened;
}

OpenedProbeDevice open_probe_device(const GlOptions&, int) {
  OpenedProbeDevice opened;
  opened.unavailable = "this build has no OpenGL side (ETALON_GPU=OFF)";
  return opened;
}

#endif

}  // namespace etalon::cli
