#include "tests/bench/gl_rival.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include <fmt/format.h>

#include "gpu/gl_format.h"
#include "gpu/gl_texture.h"

namespace etalon::bench {
namespace {

namespace gl = gpu::gl;

constexpr int kMaxTextureSize_texel = 16384;

std::string vertex_source(bool textured, bool affine) {
  const char* varying = affine ? "noperspective" : "smooth";
  return fmt::format(R"(#version 330 core
layout(location = 0) in vec4 position;
layout(location = 1) in {0} vertex_value;
{1} out {0} value;
void main() {{
  gl_Position = position;
  value = vertex_value;
}}
)",
                     textured ? "vec2" : "vec4", varying);
}

std::string fragment_source(bool textured, bool affine) {
  const char* varying = affine ? "noperspective" : "smooth";
  return fmt::format(R"(#version 330 core
{1} in {0} value;
layout(location = 0) out vec4 color;
uniform sampler2D image;
void main() {{ color = {2}; }}
)",
                     textured ? "vec2" : "vec4", varying, textured ? "texture(image, value)" : "value");
}

bool is_textured(const BenchScene& scene) { return scene.list.draws.front().shading == Shading::texture; }

bool is_affine(const BenchScene& scene) {
  return std::ranges::all_of(scene.list.vertices, [](const RasterVertex& v) { return v.w == 1; });
}

/// Clip coordinates and the one attribute that the shading needs, tightly packed.
std::vector<float> packed_vertices(const BenchScene& scene) {
  const bool textured = is_textured(scene);
  const gpu::GuardViewport viewport = gpu::guard_viewport(scene.frame);
  std::vector<float> packed;
  packed.reserve(scene.list.vertices.size() * (textured ? 6 : 8));
  for (const RasterVertex& v : scene.list.vertices) {
    // Three equal w would be taken for an affine triangle and become 1; a shared vertex keeps its own.
    RasterVertex other = v;
    other.w = v.w == 1 ? 2.0f : 1.0f;
    const Vec4f clip = gpu::clip_positions({v, other, other}, viewport, scene.frame.state.subtexel_bits)[0];
    for (int k = 0; k < 4; ++k) packed.push_back(clip[k]);
    if (textured)
      for (int k = 0; k < 2; ++k) packed.push_back(v.uv[k]);
    else
      for (int k = 0; k < 4; ++k) packed.push_back(v.color[k]);
  }
  return packed;
}

gpu::GlHandle make_target(const gl::Api& gl, gl::Enum internal_format, int width, int height) {
  gpu::GlHandle buffer = gpu::make_renderbuffer(gl);
  gl.bind_renderbuffer(gl::kRenderbuffer, buffer.id());
  gl.renderbuffer_storage(gl::kRenderbuffer, internal_format, width, height);
  return buffer;
}

}  // namespace

ResidentScene::ResidentScene(gpu::Context& context, const BenchScene& scene)
    : gl_(context.gl()),
      width_(scene.frame.width),
      height_(scene.frame.height),
      viewport_(gpu::guard_viewport(scene.frame)),
      depth_test_(scene.frame.state.depth_test),
      vertex_array_(gpu::make_vertex_array(gl_)),
      vertices_(gpu::make_buffer(gl_)),
      indices_(gpu::make_buffer(gl_)) {
  const bool textured = is_textured(scene), affine = is_affine(scene);
  program_ = gpu::make_program(gl_, vertex_source(textured, affine), fragment_source(textured, affine));
  const std::vector<float> vertices = packed_vertices(scene);
  const auto& triangles = scene.list.triangles;
  gl_.bind_vertex_array(vertex_array_.id());
  gl_.bind_buffer(gl::kArrayBuffer, vertices_.id());
  gl_.buffer_data(gl::kArrayBuffer, static_cast<gl::Sizeiptr>(vertices.size() * sizeof(float)), vertices.data(), gl::kStaticDraw);
  gl_.bind_buffer(gl::kElementArrayBuffer, indices_.id());
  gl_.buffer_data(gl::kElementArrayBuffer, static_cast<gl::Sizeiptr>(triangles.size() * sizeof(triangles[0])), triangles.data(),
                  gl::kStaticDraw);
  const int attribute_size = textured ? 2 : 4;
  const auto stride_bytes = static_cast<gl::Sizei>((4 + attribute_size) * sizeof(float));
  gl_.enable_vertex_attrib_array(0);
  gl_.vertex_attrib_pointer(0, 4, gl::kFloat, 0, stride_bytes, nullptr);
  gl_.enable_vertex_attrib_array(1);
  gl_.vertex_attrib_pointer(1, attribute_size, gl::kFloat, 0, stride_bytes, reinterpret_cast<const void*>(4 * sizeof(float)));
  gl_.use_program(program_.id());
  gl_.uniform_1i(gl_.get_uniform_location(program_.id(), "image"), 0);
  gl::check_error(gl_, "uploading a scene");
}

void ResidentScene::bind() const {
  gl_.bind_vertex_array(vertex_array_.id());
  gl_.use_program(program_.id());
  gl_.viewport(viewport_.x, viewport_.y, viewport_.width, viewport_.height);
  gl_.disable(gl::kDither);
  gl_.disable(gl::kMultisample);
  gl_.disable(gl::kBlend);
  gl_.disable(gl::kCullFace);
  gl_.disable(gl::kDepthClamp);
  if (depth_test_)
    gl_.enable(gl::kDepthTest);
  else
    gl_.disable(gl::kDepthTest);
  gl_.depth_func(gl::kLess);
  gl_.depth_mask(1);
  gl_.depth_range(0, 1);
  gl_.color_mask(1, 1, 1, 1);
  gl_.active_texture(gl::kTexture0);
}

void ResidentScene::draw(std::uint32_t first, std::uint32_t count) const {
  gl_.draw_elements(gl::kTriangles, static_cast<gl::Sizei>(3 * count), gl::kUnsignedInt,
                    reinterpret_cast<const void*>(std::size_t{first} * 3 * sizeof(std::uint32_t)));
}

GlRival::GlRival(gpu::Context& context, const BenchScene& scene)
    : resident_(context, scene),
      triangle_count_(static_cast<std::uint32_t>(scene.list.triangles.size())),
      depth_test_(scene.frame.state.depth_test),
      framebuffer_(gpu::make_framebuffer(context.gl())),
      image_(scene.frame.width, scene.frame.height, scene.frame.targets.front().format) {
  const gl::Api& gl = context.gl();
  const Draw& draw = scene.list.draws.front();
  gl.active_texture(gl::kTexture0);
  if (is_textured(scene)) texture_ = gpu::upload_texture(gl, *scene.list.images[draw.texture], draw.sampler, kMaxTextureSize_texel);
  color_ = make_target(gl, gpu::target_format(image_.format()).internal, image_.width(), image_.height());
  gl.bind_framebuffer(gl::kFramebuffer, framebuffer_.id());
  gl.framebuffer_renderbuffer(gl::kFramebuffer, gl::kColorAttachment0, gl::kRenderbuffer, color_.id());
  if (depth_test_) {
    depth_ = make_target(gl, gl::kDepthComponent32f, image_.width(), image_.height());
    gl.framebuffer_renderbuffer(gl::kFramebuffer, gl::kDepthAttachment, gl::kRenderbuffer, depth_.id());
  }
  gl.read_buffer(gl::kColorAttachment0);
  gl::check_error(gl, "attaching a scene's target");
}

void GlRival::submit() {
  const gl::Api& gl = resident_.gl();
  resident_.bind();
  gl.bind_framebuffer(gl::kFramebuffer, framebuffer_.id());
  if (texture_.id() != 0) gl.bind_texture(gl::kTexture2d, texture_.id());
  const std::array<float, 4> clear{0, 0, 0, 0};
  gl.clear_bufferfv(gl::kColor, 0, clear.data());
  const float far_depth = 1;
  if (depth_test_) gl.clear_bufferfv(gl::kDepth, 0, &far_depth);
  resident_.draw(0, triangle_count_);
}

void GlRival::draw() {
  submit();
  resident_.gl().finish();
}

void GlRival::draw_and_read_back() {
  submit();
  const gpu::GlFormat format = gpu::target_format(image_.format());
  resident_.gl().pixel_storei(gl::kPackAlignment, 1);
  resident_.gl().read_pixels(0, 0, image_.width(), image_.height(), format.components, format.type, image_.bytes().data());
  gl::check_error(resident_.gl(), "reading a scene back");
}

}  // namespace etalon::bench
