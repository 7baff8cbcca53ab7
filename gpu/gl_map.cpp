#include "gpu/gl_map.h"

#include <cstddef>
#include <memory>
#include <utility>

#include "core/base/error.h"
#include "gpu/gl_format.h"
#include "gpu/gl_texture.h"
#include "gpu/guard_viewport.h"

namespace etalon::gpu {
namespace {

constexpr gl::Uint kPosition = 0, kUv = 1, kPass = 2;

constexpr const char* kVertexSource = R"(#version 330 core
layout(location = 0) in vec4 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in uint pass;
uniform uint current_pass;
noperspective out vec2 v_uv;
flat out uint v_keeps;
void main() {
  gl_Position = position;
  v_uv = uv;
  v_keeps = uint(pass != current_pass);
}
)";

constexpr const char* kFragmentSource = R"(#version 330 core
noperspective in vec2 v_uv;
flat in uint v_keeps;
uniform sampler2D map;
layout(location = 0) out vec4 color;
void main() {
  color = v_keeps == 0u ? texture(map, v_uv) : texelFetch(map, ivec2(gl_FragCoord.xy), 0);
}
)";

}  // namespace

void GlMap::Geometry::append(const MapPass& pass, std::uint32_t number, const Frame& frame) {
  const GuardViewport viewport = guard_viewport(frame);
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (const RasterVertex& v : pass.vertices) {
    RasterVertex flat;
    flat.x = v.x, flat.y = v.y;
    const Vec4f clip = clip_positions({flat, flat, flat}, viewport, frame.state.subtexel_bits)[0];
    vertices.push_back({{clip.x, clip.y, clip.z, clip.w}, {canonical(v.uv.x), canonical(v.uv.y)}, number});
  }
  for (const auto& triangle : pass.triangles)
    for (const std::uint32_t corner : triangle) indices.push_back(first + corner);
}

void GlMap::Geometry::append(const Geometry& other) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const std::uint32_t index : other.indices) indices.push_back(first + index);
}

GlMap::GlMap(Context& context, const DeviceLimits& limits, const Image& map, const MapState& state)
    : context_(context),
      gl_(context.gl()),
      frame_(map_frame(map.width(), map.height(), map.format(), state)),
      filter_(state.filter),
      list_(map_pass_list({}, std::make_shared<const Image>(map), state.filter)) {
  validate(list_, frame_);  // looks at the map once: lookups do not leave the range of its texels
  require_size(frame_, limits);
  context_.make_current();
  program_ = make_program(gl_, kVertexSource, kFragmentSource);
  gl_.use_program(program_.id());
  gl_.uniform_1i(gl_.get_uniform_location(program_.id(), "map"), 0);
  pass_location_ = gl_.get_uniform_location(program_.id(), "current_pass");
  vertex_array_ = make_vertex_array(gl_), vertices_ = make_buffer(gl_), indices_ = make_buffer(gl_);
  gl_.bind_vertex_array(vertex_array_.id());
  gl_.bind_buffer(gl::kArrayBuffer, vertices_.id());
  gl_.bind_buffer(gl::kElementArrayBuffer, indices_.id());
  const auto attribute = [&](gl::Uint location, int size, std::size_t offset_bytes) {
    gl_.enable_vertex_attrib_array(location);
    gl_.vertex_attrib_pointer(location, size, gl::kFloat, 0, sizeof(GlVertex), reinterpret_cast<const void*>(offset_bytes));
  };
  attribute(kPosition, 4, offsetof(GlVertex, position));
  attribute(kUv, 2, offsetof(GlVertex, uv));
  gl_.enable_vertex_attrib_array(kPass);
  gl_.vertex_attrib_i_pointer(kPass, 1, gl::kUnsignedInt, sizeof(GlVertex), reinterpret_cast<const void*>(offsetof(GlVertex, pass)));
  gl::check_error(gl_, "setting up a resident map");
  for (Side& side : sides_) side = make_side(map, limits);
}

GlMap::~GlMap() {
  try {
    context_.make_current();
  } catch (const Error&) {
    // Nothing can be deleted without the context; its own end frees the objects.
  }
}

GlMap::Side GlMap::make_side(const Image& map, const DeviceLimits& limits) const {
  Side side;
  gl_.active_texture(gl::kTexture0);
  side.texture = upload_texture(gl_, map, {filter_, Wrap::clamp, Wrap::clamp}, limits.max_texture_size_texel);
  side.framebuffer = make_framebuffer(gl_);
  gl_.bind_framebuffer(gl::kFramebuffer, side.framebuffer.id());
  gl_.framebuffer_texture_2d(gl::kFramebuffer, gl::kColorAttachment0, gl::kTexture2d, side.texture.id(), 0);
  const gl::Enum drawn = gl::kColorAttachment0;
  gl_.draw_buffers(1, &drawn);
  gl_.read_buffer(drawn);
  if (gl_.check_framebuffer_status(gl::kFramebuffer) != gl::kFramebufferComplete)
    throw UnavailableError("OpenGL: a resident map: this device does not draw into textures of " + to_string(map.format()));
  gl::check_error(gl_, "making a resident map");
  return side;
}

void GlMap::set_state() {
  set_raster_state(gl_, frame_);
  gl_.disable(gl::kDepthTest);  // there is no depth
  gl_.bind_vertex_array(vertex_array_.id());
  gl_.use_program(program_.id());
  gl_.active_texture(gl::kTexture0);
}

void GlMap::upload(const Geometry& geometry) const {
  gl_.bind_buffer(gl::kArrayBuffer, vertices_.id());
  gl_.buffer_data(gl::kArrayBuffer, static_cast<gl::Sizeiptr>(geometry.vertices.size() * sizeof(GlVertex)), geometry.vertices.data(),
                  gl::kStreamDraw);
  gl_.buffer_data(gl::kElementArrayBuffer, static_cast<gl::Sizeiptr>(geometry.indices.size() * sizeof(std::uint32_t)),
                  geometry.indices.data(), gl::kStreamDraw);
  gl::check_error(gl_, "uploading the passes of a resident map");
}

void GlMap::apply(std::span<const MapPass> passes) {
  std::size_t good = 0;  // those before the first that must be refused are done all the same
  try {
    for (; good < passes.size(); ++good) {
      list_.vertices = passes[good].vertices, list_.triangles = passes[good].triangles;
      list_.draws[0].triangle_count = static_cast<std::uint32_t>(passes[good].triangles.size());
      validate_groups(passes[good]);
      validate_geometry(list_, frame_);
    }
  } catch (const InputError&) {
    draw(passes.first(good));
    throw;
  }
  draw(passes);
}

void GlMap::draw(std::span<const MapPass> passes) {
  if (passes.empty()) return;
  context_.make_current();
  set_state();
  Geometry geometry = std::exchange(last_, {});
  std::vector<std::size_t> ends = {0, geometry.indices.size()};  // of the last pass, then of each
  for (const MapPass& pass : passes) {
    geometry.append(pass, ++passes_, frame_);
    ends.push_back(geometry.indices.size());
  }
  upload(geometry);
  for (std::size_t n = 0; n < passes.size(); ++n) {
    const std::size_t from = current_, to = 1 - current_;
    gl_.bind_framebuffer(gl::kFramebuffer, sides_[to].framebuffer.id());
    gl_.bind_texture(gl::kTexture2d, sides_[from].texture.id());
    gl_.uniform_1ui(pass_location_, passes_ - static_cast<std::uint32_t>(passes.size() - 1 - n));
    gl_.draw_elements(gl::kTriangles, static_cast<gl::Sizei>(ends[n + 2] - ends[n]), gl::kUnsignedInt,
                      reinterpret_cast<const void*>(ends[n] * sizeof(std::uint32_t)));
    current_ = to;
  }
  gl::check_error(gl_, "drawing the passes of a resident map");
  last_.append(passes.back(), passes_, frame_);
}

Image GlMap::read_back() {
  context_.make_current();
  Image image(frame_.width, frame_.height, frame_.targets[0].format);
  gl_.bind_framebuffer(gl::kFramebuffer, sides_[current_].framebuffer.id());
  const GlFormat format = target_format(image.format());
  gl_.pixel_storei(gl::kPackAlignment, 1);
  gl_.read_pixels(0, 0, image.width(), image.height(), format.components, format.type, image.bytes().data());
  gl::check_error(gl_, "reading back a resident map");
  return image;
}

}  // namespace etalon::gpu
