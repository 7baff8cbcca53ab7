// What the device behind a context is and does: its own words, and what drawing small lists shows.
#pragma once

#include <optional>
#include <string>

#include "core/draw/state.h"
#include "gpu/context.h"
#include "gpu/gl_pipeline.h"

namespace etalon::gpu {

struct DeviceInfo {
  std::string renderer;                                     ///< GL_RENDERER: "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string vendor;                                       ///< GL_VENDOR
  std::string version;                                      ///< GL_VERSION
  std::string mesa_version;                                 ///< "22.3.6", from GL_VERSION; empty where the driver is not Mesa
  std::string origin;                                       ///< Context::origin()
  int subtexel_bits = 0;                                    ///< GL_SUBPIXEL_BITS: declared by the driver, not probed
  HalfRounding half_rounding = HalfRounding::nearest_even;  ///< probed by storing 1 + 3/4 of a half's step into R16F
  /// Probed: the one of the four rules by which all lattice triangles came out as exact edge functions say; nothing where none does.
  std::optional<FillRule> fill_rule;
  /// How the device brings what is off its grid to it: known for llvmpipe only (rint of the window position times 256, measured), else
  /// nothing. Raster positions are on the grid already, so no image depends on it.
  std::optional<SnapRounding> snap;
  DeviceLimits limits;

  /// "llvmpipe (LLVM 15.0.6, 256 bits), Mesa 22.3.6".
  [[nodiscard]] std::string name() const;
};

/// Draws a few hundred triangles through `pipeline`, which was made on `context`. UnavailableError as Renderer::render.
[[nodiscard]] DeviceInfo probe(Context& context, GlPipeline& pipeline);
/// The same with a pipeline of its own.
[[nodiscard]] DeviceInfo probe(Context& context);

}  // namespace etalon::gpu
