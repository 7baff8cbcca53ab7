// What the exact mode draws into: ids and depth of the visible triangles, and the stored bits of one target at a time, as integers.
// So no fixed-function conversion of a number ever touches a value.
#pragma once

#include <array>
#include <vector>

#include "core/draw/state.h"
#include "core/image/image.h"
#include "gpu/gl_objects.h"

namespace etalon::gpu {

/// Ids (a texture, for the value passes read them) and a 32-bit float depth buffer.
class VisibilityTarget {
 public:
  /// UnavailableError: the device's memory is full.
  VisibilityTarget(const gl::Api& gl, int width, int height, int max_size);

  [[nodiscard]] bool matches(const Frame& frame) const { return width_ == frame.width && height_ == frame.height; }
  /// Binds it; ids become kNoTriangle, depths 1.
  void bind_and_clear() const;
  [[nodiscard]] gl::Uint ids() const { return ids_.id(); }
  /// The ids, or the depths, as the image of a target; bound or not.
  [[nodiscard]] Image read_ids() const;
  [[nodiscard]] Image read_depth() const;

 private:
  const gl::Api& gl_;
  int width_, height_;
  GlHandle ids_, depth_, framebuffer_;
};

/// The bits of one target's texels, and flags beside them.
class ValueTarget {
 public:
  /// UnavailableError: the device's memory is full. `flags`: a second attachment of R uint32.
  ValueTarget(const gl::Api& gl, int width, int height, PixelFormat format, bool flags);

  /// Binds it; every texel becomes the spec's clear value as the contract stores it, every flag 0.
  void bind_and_clear(const TargetSpec& spec, HalfRounding rounding) const;
  /// The target's image, or its flags; it must be bound.
  [[nodiscard]] Image read() const;
  [[nodiscard]] Image read_flags() const;

 private:
  const gl::Api& gl_;
  int width_, height_;
  PixelFormat format_;
  GlHandle values_, flags_, framebuffer_;
};

/// The bits a finite float32 is stored as: one rounding, docs/contract.md#storage. `alpha`: the fourth channel, linear in srgb8 too.
[[nodiscard]] std::uint32_t stored_bits(float value, ChannelType type, bool alpha, HalfRounding rounding);

}  // namespace etalon::gpu
