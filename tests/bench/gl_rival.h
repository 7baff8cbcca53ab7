// The same drawings on OpenGL, as fast as an application could ask for them: vertices, indices, texture and program resident, indexed
// drawing, no depth buffer where none is needed, interpolation without perspective where all w are equal. gpu::GlRenderer is not timed: it uploads the
// list each time, without shared vertices, since its business is to show what the device computes.
#pragma once

#include <cstdint>

#include "gpu/context.h"
#include "gpu/gl_objects.h"
#include "gpu/guard_viewport.h"
#include "tests/bench/bench_scene.h"

namespace etalon::bench {

/// The vertices, indices and program of a scene on the device. The context must outlive it and be current.
class ResidentScene {
 public:
  ResidentScene(gpu::Context& context, const BenchScene& scene);

  /// Binds program, arrays and the viewport, and sets the state; nothing is drawn.
  void bind() const;
  /// Draws `count` triangles from `first` on.
  void draw(std::uint32_t first, std::uint32_t count) const;
  [[nodiscard]] const gpu::gl::Api& gl() const { return gl_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  const gpu::gl::Api& gl_;
  int width_, height_;
  gpu::GuardViewport viewport_;  ///< powers of two: larger than frames that are none
  bool depth_test_;
  gpu::GlHandle vertex_array_, vertices_, indices_, program_;
};

/// A scene with its target.
class GlRival {
 public:
  GlRival(gpu::Context& context, const BenchScene& scene);

  /// Clears, draws, waits until it is done.
  void draw();
  /// Clears, draws, copies the target's texels to memory that is there already.
  void draw_and_read_back();
  /// Of the last draw_and_read_back().
  [[nodiscard]] const Image& image() const { return image_; }

 private:
  void submit();

  ResidentScene resident_;
  std::uint32_t triangle_count_;
  bool depth_test_;
  gpu::GlHandle texture_, color_, depth_, framebuffer_;
  Image image_;
};

/// The ways a device can update a map fan by fan; all give the same map.
class FanRival {
 public:
  /// `scene`: fan_scene().
  FanRival(gpu::Context& context, const BenchScene& scene);

  /// Gives maps A and B the source again, so that what is read next was drawn by the way in question.
  void reset();
  /// Draws all fans and waits until they are done: `fans_per_bind` left fans from map A to B, as many right ones from B to A, and so on.
  void draw_back_and_forth(std::uint32_t fans_per_bind);
  /// The same in one pass from the source to a third map: what can be done where no fan reads what another wrote.
  void draw_at_once();

  /// The map that the ways above made: B's left half and A's right half; or the third map.
  [[nodiscard]] Image back_and_forth_map() const;
  [[nodiscard]] Image map_at_once() const;

 private:
  struct Map {
    gpu::GlHandle texture, framebuffer;
  };
  [[nodiscard]] Map make_map(const Image& content) const;
  [[nodiscard]] Image read(const Map& map) const;

  Image content_;  ///< of the source map
  std::uint32_t fan_count_;
  ResidentScene resident_;  ///< left fans first, then right ones: what one bind draws is one range
  const gpu::gl::Api& gl_;
  Map a_, b_, source_, target_;
};

}  // namespace etalon::bench
