// OpenGL drawing a list as it stands, for those who ask what the device does with it: positions may be finer than its grid, and neither its
// fill rule nor its half rounding need be the frame's. GlRenderer, for those who compare, refuses all that.
#pragma once

#include <memory>

#include "core/draw/renderer.h"
#include "gpu/context.h"
#include "gpu/gl_pipeline.h"
#include "gpu/probe.h"

namespace etalon::gpu {

class UncheckedRenderer : public Renderer {
 public:
  /// UnavailableError as make_context() and probe().
  explicit UncheckedRenderer(const ContextOptions& options = {});
  ~UncheckedRenderer() override;

  [[nodiscard]] std::string name() const override { return device_.name(); }
  [[nodiscard]] RasterState supported_state(const RasterState& wanted) const override { return wanted; }
  /// All but srgb8, margins and bound_terms.
  [[nodiscard]] bool supports(const TargetSpec& target) const override;
  /// InputError: validate() refuses. UnavailableError: a target that supports() refuses; the device's limits or memory exceeded.
  [[nodiscard]] std::vector<Image> render(const DrawList& list, const Frame& frame) override;

  [[nodiscard]] const DeviceInfo& device() const { return device_; }

 private:
  std::unique_ptr<Context> context_;
  std::unique_ptr<GlPipeline> pipeline_;  ///< dies before its context
  DeviceInfo device_;
};

}  // namespace etalon::gpu
