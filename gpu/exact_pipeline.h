// Draws a list with the contract evaluated in shaders: identical bytes wherever the device's coverage is the contract's
// (docs/exact-shader.md). Visibility first, with exact depth; then the stored bits of each target by doubles with a proven bound,
// which flag the texels that they cannot decide; then these, as a dense list, by integers.
// Does: colour (vertex colours, texture, indexed; nearest and linear), id, barycentrics, coordinate, depth; all formats; both roundings of
// halves. Does not: margins, bound terms.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/draw/draw_list.h"
#include "gpu/context.h"
#include "gpu/exact_records.h"
#include "gpu/exact_shaders.h"
#include "gpu/exact_target.h"
#include "gpu/gl_pipeline.h"

namespace etalon::gpu {

/// Of the last call.
struct ExactCounters {
  std::uint64_t undecided = 0;  ///< texels settled by integers, once for each target
};

/// Programs and the last frame's targets are kept between calls. The context must outlive it.
class ExactPipeline {
 public:
  /// UnavailableError: the context is older than OpenGL 4.0, which has doubles in shaders, or these are not IEEE's. `integers_only`: integers for
  /// every texel, whatever doubles could decide: a second opinion.
  ExactPipeline(Context& context, const DeviceLimits& limits, bool integers_only = false);
  ~ExactPipeline();
  ExactPipeline(const ExactPipeline&) = delete;
  ExactPipeline& operator=(const ExactPipeline&) = delete;

  /// As Renderer::render for a valid list and at most kExactSubtexelBits; UnavailableError where the device's limits or memory are exceeded
  /// or it reports any error.
  [[nodiscard]] std::vector<Image> draw(const DrawList& list, const Frame& frame);

  [[nodiscard]] const ExactCounters& counters() const { return counters_; }

 private:
  using ImageTextures = std::map<std::uint32_t, GlHandle>;  ///< by index of DrawList::images

  [[nodiscard]] gl::Uint use_program(const std::string& vertex_source, const std::string& fragment_source);
  void set_value_uniforms(gl::Uint program, const Frame& frame, const TargetSpec& target, const Draw& draw, std::uint32_t group) const;
  void bind(int unit, gl::Uint texture) const;
  void draw_visibility(const DrawList& list, const Frame& frame);
  [[nodiscard]] Image draw_values(const ExactRecords& records, const DrawList& list, const Frame& frame, const TargetSpec& target,
                                  ImageTextures& images);
  /// Replaces the flagged texels of a value image by what the integers say.
  void settle(const ExactRecords& records, const DrawList& list, const Frame& frame, const TargetSpec& target, const Image& flags,
              ImageTextures& images, Image& values);
  /// The same for a list of texels, x | y << 16; program, uniforms and images are bound.
  void settle_list(std::span<const std::uint32_t> places, Image& values);
  void bind_group(const DrawList& list, const TargetSpec& target, const Draw& draw, ImageTextures& images) const;
  void bind_image(const DrawList& list, std::uint32_t image, int unit, ImageTextures& images) const;

  Context& context_;
  const gl::Api& gl_;
  DeviceLimits limits_;
  bool integers_only_;
  ExactCounters counters_;
  GlHandle vertex_array_;  ///< without attributes: the shaders read records
  GlHandle srgb_tables_;
  std::map<std::string, GlHandle> programs_;  ///< by fragment source
  std::unique_ptr<VisibilityTarget> visibility_;
};

}  // namespace etalon::gpu
