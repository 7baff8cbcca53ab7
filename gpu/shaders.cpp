#include "gpu/shaders.h"

#include <fmt/core.h>

#include "core/base/error.h"

namespace etalon::gpu {

namespace {

std::string color_expression(Shading shading) {
  switch (shading) {
    case Shading::vertex_color: return "v_color";
    case Shading::texture: return "texture(image, v_uv)";
    case Shading::indexed: return "texture(image, texture(indexing_map, v_uv).rg)";
  }
  ETALON_CHECK(false, fmt::format("shading {}", static_cast<int>(shading)));
  return {};
}

}  // namespace

std::string vertex_shader_source() {
  return R"(#version 330 core
layout(location = 0) in vec4 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color;
layout(location = 3) in uvec2 identity;
smooth out vec2 v_uv;
smooth out vec4 v_color;
smooth out vec3 v_barycentrics;
flat out uint v_triangle;
void main() {
  gl_Position = position;
  v_uv = uv;
  v_color = color;
  uint corner = identity.y;
  v_barycentrics = vec3(corner == 0u, corner == 1u, corner == 2u);
  v_triangle = identity.x;
}
)";
}

std::string fragment_shader_source(Shading shading, const std::vector<TargetSpec>& targets) {
  std::string outputs;
  std::string body;
  int location = 0;
  for (const TargetSpec& target : targets) {
    if (target.content == TargetContent::depth) continue;
    const bool is_id = target.content == TargetContent::triangle_id;
    outputs += fmt::format("layout(location = {0}) out {1} out_{0};\n", location, is_id ? "uint" : "vec4");
    std::string value;
    switch (target.content) {
      case TargetContent::color: value = color_expression(shading); break;
      case TargetContent::triangle_id: value = "v_triangle"; break;
      case TargetContent::barycentrics: value = "vec4(v_barycentrics, 1.0)"; break;
      case TargetContent::coordinate: value = "vec4(v_uv, 0.0, 1.0)"; break;
      case TargetContent::depth:
      case TargetContent::margins:
      case TargetContent::bound_terms: ETALON_CHECK(false, to_string(target.content));
    }
    body += fmt::format("  out_{} = {};\n", location, value);
    ++location;
  }
  return "#version 330 core\n"
         "smooth in vec2 v_uv;\n"
         "smooth in vec4 v_color;\n"
         "smooth in vec3 v_barycentrics;\n"
         "flat in uint v_triangle;\n"
         "uniform sampler2D image;\n"
         "uniform sampler2D indexing_map;\n" +
         outputs + "void main() {\n" + body + "}\n";
}

}  // namespace etalon::gpu
