#include "gpu/gl_objects.h"

#include <algorithm>

#include <fmt/core.h>

#include "core/base/error.h"

namespace etalon::gpu {

namespace {

template <class Generate>
GlHandle make_named(const gl::Api& gl, Generate generate, GlHandle::Deleter deleter, const char* kind) {
  gl::Uint id = 0;
  generate(1, &id);
  gl::check_error(gl, fmt::format("making a {}", kind));
  return {gl, id, deleter};
}

/// The log as one line, so that an error stays one line.
std::string one_line(std::string log) {
  while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
  std::replace(log.begin(), log.end(), '\n', ' ');
  return log;
}

GlHandle compile(const gl::Api& gl, gl::Enum stage, const std::string& source) {
  GlHandle shader(gl, gl.create_shader(stage), [](const gl::Api& api, gl::Uint id) { api.delete_shader(id); });
  const char* text = source.c_str();
  gl.shader_source(shader.id(), 1, &text, nullptr);
  gl.compile_shader(shader.id());
  gl::Int compiled = 0;
  gl.get_shaderiv(shader.id(), gl::kCompileStatus, &compiled);
  if (compiled != 0) return shader;
  gl::Int length = 0;
  gl.get_shaderiv(shader.id(), gl::kInfoLogLength, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  gl.get_shader_info_log(shader.id(), static_cast<gl::Sizei>(log.size()), nullptr, log.data());
  throw UnavailableError(
      fmt::format("OpenGL: compiling the {} shader: {}", stage == gl::kVertexShader ? "vertex" : "fragment", one_line(std::move(log))));
}

}  // namespace

GlHandle make_buffer(const gl::Api& gl) {
  return make_named(
      gl, gl.gen_buffers, [](const gl::Api& api, gl::Uint id) { api.delete_buffers(1, &id); }, "buffer");
}

GlHandle make_vertex_array(const gl::Api& gl) {
  return make_named(
      gl, gl.gen_vertex_arrays, [](const gl::Api& api, gl::Uint id) { api.delete_vertex_arrays(1, &id); }, "vertex array");
}

GlHandle make_renderbuffer(const gl::Api& gl) {
  return make_named(
      gl, gl.gen_renderbuffers, [](const gl::Api& api, gl::Uint id) { api.delete_renderbuffers(1, &id); }, "renderbuffer");
}

GlHandle make_framebuffer(const gl::Api& gl) {
  return make_named(
      gl, gl.gen_framebuffers, [](const gl::Api& api, gl::Uint id) { api.delete_framebuffers(1, &id); }, "framebuffer");
}

GlHandle make_texture(const gl::Api& gl) {
  return make_named(
      gl, gl.gen_textures, [](const gl::Api& api, gl::Uint id) { api.delete_textures(1, &id); }, "texture");
}

GlHandle make_program(const gl::Api& gl, const std::string& vertex_source, const std::string& fragment_source) {
  const GlHandle vertex = compile(gl, gl::kVertexShader, vertex_source);
  const GlHandle fragment = compile(gl, gl::kFragmentShader, fragment_source);
  GlHandle program(gl, gl.create_program(), [](const gl::Api& api, gl::Uint id) { api.delete_program(id); });
  gl.attach_shader(program.id(), vertex.id());
  gl.attach_shader(program.id(), fragment.id());
  gl.link_program(program.id());
  gl::Int linked = 0;
  gl.get_programiv(program.id(), gl::kLinkStatus, &linked);
  if (linked != 0) return program;
  gl::Int length = 0;
  gl.get_programiv(program.id(), gl::kInfoLogLength, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  gl.get_program_info_log(program.id(), static_cast<gl::Sizei>(log.size()), nullptr, log.data());
  throw UnavailableError(fmt::format("OpenGL: linking the program: {}", one_line(std::move(log))));
}

}  // namespace etalon::gpu
