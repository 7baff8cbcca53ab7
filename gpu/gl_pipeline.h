// Draws a list with OpenGL as it stands: no validation, no question whether the device honours the state. GlRenderer asks those first;
// probe() uses the pipeline to find out what the device does.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/draw/draw_list.h"
#include "gpu/context.h"
#include "gpu/gl_objects.h"
#include "gpu/gl_target.h"

namespace etalon::gpu {

/// Upper limits of the device.
struct DeviceLimits {
  int max_texture_size_texel = 0;
  int max_target_size_texel = 0;
  int max_viewport_width_texel = 0;
  int max_viewport_height_texel = 0;
  int max_color_targets = 0;
};

/// UnavailableError where frame or guard viewport exceed the device.
void require_size(const Frame& frame, const DeviceLimits& limits);

/// Viewport, culling and depth test of a frame; everything that could change a colour on its way to a target is off.
void set_raster_state(const gl::Api& gl, const Frame& frame);

/// Programs, buffers and the last frame's targets are kept between calls. The context must outlive it.
class GlPipeline {
 public:
  explicit GlPipeline(Context& context);
  ~GlPipeline();
  GlPipeline(const GlPipeline&) = delete;
  GlPipeline& operator=(const GlPipeline&) = delete;

  [[nodiscard]] const DeviceLimits& limits() const { return limits_; }

  /// As Renderer::render; UnavailableError where the device's limits or memory are exceeded or it reports any error.
  [[nodiscard]] std::vector<Image> draw(const DrawList& list, const Frame& frame);

 private:
  /// One per distinct (image, sampler) of a call.
  struct TextureKey {
    std::uint32_t image;
    Sampler sampler;
    friend bool operator==(const TextureKey&, const TextureKey&) = default;
  };
  using Textures = std::vector<std::pair<TextureKey, GlHandle>>;

  void check_limits(const Frame& frame) const;
  void prepare_targets(const Frame& frame);
  [[nodiscard]] gl::Uint program_for(Shading shading, const std::vector<TargetSpec>& targets);
  void draw_triangles(const DrawList& list, const Frame& frame, bool shaded, Textures& textures);
  void bind_textures(const DrawList& list, const Draw& draw, Textures& textures) const;
  void bind_texture(const DrawList& list, std::uint32_t image, const Sampler& sampler, int unit, Textures& textures) const;
  void fill_buffer(const DrawList& list, const Frame& frame, std::uint32_t first, std::uint32_t count);

  /// A vertex as the buffer holds it.
  struct GlVertex {
    float position[4];
    float uv[2];
    float color[4];
    std::uint32_t identity[2];  ///< triangle id, corner
  };

  Context& context_;
  const gl::Api& gl_;
  DeviceLimits limits_;
  GlHandle vertex_array_;
  GlHandle vertex_buffer_;
  std::vector<GlVertex> staging_;
  std::map<std::string, GlHandle> programs_;  ///< by fragment source
  std::unique_ptr<GlTargets> targets_;
};

}  // namespace etalon::gpu
