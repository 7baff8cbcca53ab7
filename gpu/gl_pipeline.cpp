#include "gpu/gl_pipeline.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "gpu/gl_texture.h"
#include "gpu/guard_viewport.h"
#include "gpu/shaders.h"

namespace etalon::gpu {

namespace {

/// Triangles per vertex buffer: 2^16 · 120 bytes keep a list of millions in about 8 MB of staging and device memory.
constexpr std::uint32_t kTrianglesPerBuffer = 1u << 16;
constexpr std::size_t kTrianglesPerTask = 4096;

int integer(const gl::Api& gl, gl::Enum name) {
  gl::Int value = 0;
  gl.get_integerv(name, &value);
  return value;
}

DeviceLimits query_limits(const gl::Api& gl) {
  std::array<gl::Int, 2> viewport{};
  gl.get_integerv(gl::kMaxViewportDims, viewport.data());
  return {.max_texture_size_texel = integer(gl, gl::kMaxTextureSize),
          .max_target_size_texel = integer(gl, gl::kMaxRenderbufferSize),
          .max_viewport_width_texel = viewport[0],
          .max_viewport_height_texel = viewport[1],
          .max_color_targets = integer(gl, gl::kMaxDrawBuffers)};
}

bool has_content(const Frame& frame, TargetContent content) {
  return std::any_of(frame.targets.begin(), frame.targets.end(), [&](const TargetSpec& spec) { return spec.content == content; });
}

}  // namespace

void require_size(const Frame& frame, const DeviceLimits& limits) {
  if (frame.width > limits.max_target_size_texel || frame.height > limits.max_target_size_texel) {
    throw UnavailableError(fmt::format("OpenGL: a frame of {} x {} texels: this device draws at most {} a side", frame.width, frame.height,
                                       limits.max_target_size_texel));
  }
  const GuardViewport viewport = guard_viewport(frame);
  if (viewport.width > limits.max_viewport_width_texel || viewport.height > limits.max_viewport_height_texel) {
    throw UnavailableError(fmt::format("OpenGL: frame and guard need a viewport of {} x {} texels: this device has at most {} x {}",
                                       viewport.width, viewport.height, limits.max_viewport_width_texel, limits.max_viewport_height_texel));
  }
}

void set_raster_state(const gl::Api& gl, const Frame& frame) {
  const GuardViewport viewport = guard_viewport(frame);
  gl.viewport(viewport.x, viewport.y, viewport.width, viewport.height);
  gl.pixel_storei(gl::kPackAlignment, 1);
  gl.disable(gl::kDither);       // on by default
  gl.disable(gl::kMultisample);  // on by default
  gl.disable(gl::kBlend);
  gl.disable(gl::kScissorTest);
  gl.disable(gl::kStencilTest);
  gl.disable(gl::kFramebufferSrgb);
  gl.color_mask(1, 1, 1, 1);
  // No vertex is beyond the planes z = ±w (rounding (2z − 1)·w keeps the order), so nothing is clipped either way; the clamp keeps a
  // device from writing a depth that it interpolated past 0 or 1. llvmpipe was seen to draw the same without it.
  gl.enable(gl::kDepthClamp);
  gl.depth_range(0, 1);
  // Disabling the depth test would also stop depth from being written.
  gl.enable(gl::kDepthTest);
  gl.depth_func(frame.state.depth_test ? gl::kLess : gl::kAlways);
  gl.depth_mask(1);
  if (frame.state.cull == CullMode::none) {
    gl.disable(gl::kCullFace);
  } else {
    // Rows grow upwards as OpenGL's window does, so its orientation is ours.
    gl.enable(gl::kCullFace);
    gl.cull_face(gl::kBack);
    gl.front_face(frame.state.cull == CullMode::clockwise ? gl::kCcw : gl::kCw);
  }
  gl::check_error(gl, "setting the state");
}

GlPipeline::GlPipeline(Context& context) : context_(context), gl_(context.gl()) {
  context_.make_current();
  limits_ = query_limits(gl_);
  vertex_array_ = make_vertex_array(gl_);
  vertex_buffer_ = make_buffer(gl_);
  gl_.bind_vertex_array(vertex_array_.id());
  gl_.bind_buffer(gl::kArrayBuffer, vertex_buffer_.id());
  const auto attribute = [&](gl::Uint location, int size, std::size_t offset_bytes) {
    gl_.enable_vertex_attrib_array(location);
    gl_.vertex_attrib_pointer(location, size, gl::kFloat, 0, sizeof(GlVertex), reinterpret_cast<const void*>(offset_bytes));
  };
  attribute(kPositionLocation, 4, offsetof(GlVertex, position));
  attribute(kUvLocation, 2, offsetof(GlVertex, uv));
  attribute(kColorLocation, 4, offsetof(GlVertex, color));
  gl_.enable_vertex_attrib_array(kIdentityLocation);
  gl_.vertex_attrib_i_pointer(kIdentityLocation, 2, gl::kUnsignedInt, sizeof(GlVertex),
                              reinterpret_cast<const void*>(offsetof(GlVertex, identity)));
  gl::check_error(gl_, "setting up the vertex buffer");
}

GlPipeline::~GlPipeline() {
  try {
    context_.make_current();
  } catch (const Error&) {
    // Nothing can be deleted without the context; its own end frees the objects.
  }
}

std::vector<Image> GlPipeline::draw(const DrawList& list, const Frame& frame) {
  check_limits(frame);
  context_.make_current();
  prepare_targets(frame);
  targets_->bind_and_clear(frame);
  set_raster_state(gl_, frame);
  gl_.bind_vertex_array(vertex_array_.id());
  gl_.bind_buffer(gl::kArrayBuffer, vertex_buffer_.id());
  Textures textures;
  draw_triangles(list, frame, has_content(frame, TargetContent::color), textures);
  return targets_->read_back();
}

void GlPipeline::check_limits(const Frame& frame) const {
  require_size(frame, limits_);
  const auto colors = std::count_if(frame.targets.begin(), frame.targets.end(),
                                    [](const TargetSpec& spec) { return spec.content != TargetContent::depth; });
  if (colors > limits_.max_color_targets) {
    throw UnavailableError(
        fmt::format("OpenGL: {} targets in one frame: this device takes at most {} beside depth", colors, limits_.max_color_targets));
  }
}

void GlPipeline::prepare_targets(const Frame& frame) {
  if (targets_ && targets_->matches(frame)) return;
  targets_.reset();  // before the new ones: both together might not fit into memory
  targets_ = std::make_unique<GlTargets>(gl_, frame);
}

gl::Uint GlPipeline::program_for(Shading shading, const std::vector<TargetSpec>& targets) {
  const std::string fragment_source = fragment_shader_source(shading, targets);
  const auto found = programs_.find(fragment_source);
  if (found != programs_.end()) return found->second.id();
  GlHandle program = make_program(gl_, vertex_shader_source(), fragment_source);
  gl_.use_program(program.id());
  // A location of -1, of a sampler that the program does not use, is ignored by OpenGL.
  gl_.uniform_1i(gl_.get_uniform_location(program.id(), "image"), kImageUnit);
  gl_.uniform_1i(gl_.get_uniform_location(program.id(), "indexing_map"), kIndexingMapUnit);
  gl::check_error(gl_, "preparing the program");
  return programs_.emplace(fragment_source, std::move(program)).first->second.id();
}

void GlPipeline::draw_triangles(const DrawList& list, const Frame& frame, bool shaded, Textures& textures) {
  const auto triangle_count = static_cast<std::uint32_t>(list.triangles.size());
  auto draw = list.draws.begin();
  for (std::uint32_t first = 0; first < triangle_count; first += kTrianglesPerBuffer) {
    const std::uint32_t end = first + std::min(kTrianglesPerBuffer, triangle_count - first);
    fill_buffer(list, frame, first, end - first);
    for (std::uint32_t t = first; t < end;) {
      while (t >= draw->first_triangle + draw->triangle_count) ++draw;
      const std::uint32_t draw_end = std::min(end, draw->first_triangle + draw->triangle_count);
      const gl::Uint program = program_for(shaded ? draw->shading : Shading::vertex_color, frame.targets);
      if (shaded) bind_textures(list, *draw, textures);
      gl_.use_program(program);
      gl_.draw_arrays(gl::kTriangles, static_cast<gl::Int>(3 * (t - first)), static_cast<gl::Sizei>(3 * (draw_end - t)));
      t = draw_end;
    }
    gl::check_error(gl_, fmt::format("drawing triangles {} to {}", first, end - 1));
  }
}

void GlPipeline::bind_textures(const DrawList& list, const Draw& draw, Textures& textures) const {
  if (draw.shading == Shading::vertex_color) return;
  if (draw.shading == Shading::indexed) bind_texture(list, draw.indexing_map, draw.map_sampler, kIndexingMapUnit, textures);
  bind_texture(list, draw.texture, draw.sampler, kImageUnit, textures);
}

void GlPipeline::bind_texture(const DrawList& list, std::uint32_t image, const Sampler& sampler, int unit, Textures& textures) const {
  gl_.active_texture(gl::kTexture0 + static_cast<gl::Enum>(unit));
  const TextureKey key{image, sampler};
  const auto found = std::find_if(textures.begin(), textures.end(), [&](const auto& entry) { return entry.first == key; });
  if (found != textures.end()) {
    gl_.bind_texture(gl::kTexture2d, found->second.id());
  } else {
    textures.emplace_back(key, upload_texture(gl_, *list.images[image], sampler, limits_.max_texture_size_texel));
  }
}

void GlPipeline::fill_buffer(const DrawList& list, const Frame& frame, std::uint32_t first, std::uint32_t count) {
  const GuardViewport viewport = guard_viewport(frame);
  staging_.resize(std::size_t{3} * count);
  parallel_for_blocks(count, kTrianglesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& corners = list.triangles[first + i];
      const std::array<RasterVertex, 3> triangle{list.vertices[corners[0]], list.vertices[corners[1]], list.vertices[corners[2]]};
      const std::array<Vec4f, 3> clip = clip_positions(triangle, viewport, frame.state.subtexel_bits);
      for (std::size_t k = 0; k < 3; ++k) {
        const RasterVertex& v = triangle[k];
        staging_[3 * i + k] = {{clip[k].x, clip[k].y, clip[k].z, clip[k].w},
                               {canonical(v.uv.x), canonical(v.uv.y)},
                               {canonical(v.color.x), canonical(v.color.y), canonical(v.color.z), canonical(v.color.w)},
                               {static_cast<std::uint32_t>(first + i), static_cast<std::uint32_t>(k)}};
      }
    }
  });
  gl_.buffer_data(gl::kArrayBuffer, static_cast<gl::Sizeiptr>(staging_.size() * sizeof(GlVertex)), staging_.data(), gl::kStreamDraw);
  gl::check_error(gl_, fmt::format("uploading {} triangles", count));
}

}  // namespace etalon::gpu
