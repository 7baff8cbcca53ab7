// What is drawn into: one framebuffer object with a renderbuffer per colour-like target and a 32-bit float depth buffer.
#pragma once

#include <vector>

#include "core/draw/state.h"
#include "core/image/image.h"
#include "gpu/gl_objects.h"

namespace etalon::gpu {

/// Owns the renderbuffers of a frame's targets. Depth targets are read from the depth buffer and take no colour attachment.
class GlTargets {
 public:
  /// UnavailableError: the device's memory is full, or the framebuffer is incomplete.
  GlTargets(const gl::Api& gl, const Frame& frame);

  /// Whether this object serves `frame`: same size, same contents and formats.
  [[nodiscard]] bool matches(const Frame& frame) const;

  /// Binds the framebuffer and clears every attachment to what the frame's specs say.
  void bind_and_clear(const Frame& frame) const;

  /// One image per target, in order; the framebuffer must be bound.
  [[nodiscard]] std::vector<Image> read_back() const;

 private:
  [[nodiscard]] Image read_target(const TargetSpec& spec, int attachment) const;

  const gl::Api& gl_;
  int width_;
  int height_;
  std::vector<TargetSpec> specs_;
  std::vector<GlHandle> colors_;  ///< one per target that is not depth, in order
  GlHandle depth_;
  GlHandle framebuffer_;
};

}  // namespace etalon::gpu
