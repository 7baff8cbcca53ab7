// Draws the same lists as the CPU renderer, with OpenGL 3.3 and the shaders an application would write.
// Does: colour (vertex colours, texture, indexed), triangle id, barycentrics, coordinate, depth, in one pass over one framebuffer object.
// Does not: sRGB targets, margins, bound terms; exact values. Values are the device's: interpolated in float32 from these inputs:
//   positions and depth   gpu/guard_viewport.h
//   uv, colours           the vertices' float32 through canonical(), as smooth varyings of float32
//   barycentrics          smooth varyings (1,0,0), (0,1,0), (0,0,1)
//   textures              stored exactly, one level, min = mag filter; texture() at the interpolated coordinate
// Coverage, depth order and ids follow the frame's state as the device's own rules do (DeviceInfo).
#pragma once

#include <memory>

#include "core/draw/renderer.h"
#include "gpu/context.h"
#include "gpu/exact_pipeline.h"
#include "gpu/gl_pipeline.h"
#include "gpu/probe.h"

namespace etalon::gpu {

/// Where values come from: interpolated by the device, or the contract evaluated in the shader (docs/exact-shader.md).
enum class ShaderMode : std::uint8_t {
  native,  ///< what an application would write
  exact,   ///< identical bytes wherever coverage is; OpenGL 4.0
};
[[nodiscard]] std::string to_string(ShaderMode mode);

/// Not thread-safe; several renderers may live in one process, each with its context.
class GlRenderer : public Renderer {
 public:
  /// Takes a context and probes it; UnavailableError as make_context() and render(), and where the device cannot run the exact shader.
  explicit GlRenderer(std::unique_ptr<Context> context, ShaderMode mode = ShaderMode::native);
  explicit GlRenderer(const ContextOptions& options = {}, ShaderMode mode = ShaderMode::native);
  ~GlRenderer() override;

  [[nodiscard]] std::string name() const override;

  /// `wanted` with what the device has of its own: at most its sub-texel bits, its fill rule, its half rounding.
  [[nodiscard]] RasterState supported_state(const RasterState& wanted) const override;

  /// colour, barycentrics and coordinate in unorm8, unorm16, half, float32; id; depth. Not srgb8, margins, bound_terms.
  [[nodiscard]] bool supports(const TargetSpec& target) const override;

  /// InputError: validate() refuses. UnavailableError, one line: a target supports() refuses; a state other than supported_state()
  /// gives (half rounding counts only with a half target); a device whose fill rule is none of the four; the device's limits or
  /// memory exceeded; any OpenGL error, with the step. The renderer stays usable.
  [[nodiscard]] std::vector<Image> render(const DrawList& list, const Frame& frame) override;

  /// On the device, bytes as render()'s; srgb8, formats of three channels, and all formats in exact mode: by render().
  [[nodiscard]] std::unique_ptr<ResidentMap> make_map(Image map, const MapState& state) override;

  [[nodiscard]] const DeviceInfo& device() const { return device_; }
  [[nodiscard]] ShaderMode shader_mode() const { return exact_ ? ShaderMode::exact : ShaderMode::native; }

 private:
  void require_support(const Frame& frame) const;

  std::unique_ptr<Context> context_;
  std::unique_ptr<GlPipeline> pipeline_;  ///< dies before its context
  DeviceInfo device_;
  std::unique_ptr<ExactPipeline> exact_;  ///< in exact mode; dies before its context
};

}  // namespace etalon::gpu
