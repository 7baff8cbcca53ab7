#include "gpu/exact_shaders.h"

#include <fmt/core.h>

#include "gpu/exact_glsl.h"

namespace etalon::gpu {

namespace {

// z as integers of one scale: 24 bits and 2^-40 .. 1; E below 2^45 (docs/exact-shader.md#widths).
constexpr int kDepthLimbs = 4;

}  // namespace

std::string exact_shader_head(int limbs) {
  int half_limbs = 1;
  while (2 * half_limbs < limbs) half_limbs *= 2;
  return fmt::format("#version 400 core\n#define LIMBS {}\n#define HALF_LIMBS {}\n#define RECORD_WIDTH {}u\nuniform int subtexel_bits;\n",
                     limbs, half_limbs, kRecordWidth);
}

std::string joined(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) text += part;
  return text;
}

std::string visibility_vertex_source() {
  return fmt::format("#version 400 core\n#define RECORD_WIDTH {}u\n", kRecordWidth) + R"(
uniform usampler2D vertices;
uniform usampler2D triangles;
uniform ivec2 center;         // of the viewport, sub-texels
uniform vec2 inverse_extent;  // of half the viewport, sub-texels; powers of two
flat out ivec2 v_corner0;
flat out ivec2 v_corner1;
flat out ivec2 v_corner2;
flat out uvec3 v_depth;
flat out uint v_triangle;

ivec2 record(uint index) { return ivec2(index & (RECORD_WIDTH - 1u), index / RECORD_WIDTH); }

void main() {
  uint id = uint(gl_VertexID) / 3u;
  uvec4 triangle = texelFetch(triangles, record(id), 0);
  uvec4 words0 = texelFetch(vertices, record(3u * triangle.x), 0);
  uvec4 words1 = texelFetch(vertices, record(3u * triangle.y), 0);
  uvec4 words2 = texelFetch(vertices, record(3u * triangle.z), 0);
  v_corner0 = ivec2(words0.xy);
  v_corner1 = ivec2(words1.xy);
  v_corner2 = ivec2(words2.xy);
  v_depth = uvec3(words0.z, words1.z, words2.z);
  v_triangle = id;
  uint turn = uint(gl_VertexID) % 3u;
  ivec2 mine = turn == 0u ? v_corner0 : turn == 1u ? v_corner1 : v_corner2;
  gl_Position = vec4(vec2(mine - center) * inverse_extent, 0.0, 1.0);
}
)";
}

std::string visibility_fragment_source(bool integers_only) {
  return exact_shader_head(kDepthLimbs) + joined({kGlslIntegers, kGlslNumbers, kGlslBits, kGlslFloat32}) + R"(
flat in ivec2 v_corner0;
flat in ivec2 v_corner1;
flat in ivec2 v_corner2;
flat in uvec3 v_depth;
flat in uint v_triangle;
layout(location = 0) out uint id;

void main() {
  texel = ivec2(gl_FragCoord.xy);
  corner[0] = v_corner0;
  corner[1] = v_corner1;
  corner[2] = v_corner2;
  corner_w[0] = corner_w[1] = corner_w[2] = 0x3F800000u;
  affine = true;
  set_edges();
  dvec3 z = dvec3(uintBitsToFloat(v_depth));
  precise double depth = ((edge[0] * z.x + edge[1] * z.y) + edge[2] * z.z) / area;
  precise double error = depth * kEnclosure;
  precise double lo = depth - error, hi = depth + error;
  uint code;
  bool decided = try_float32(lo, hi, code);
  if ()" +
         std::string(integers_only ? "true" : "!decided") +
         R"() code = float32_code(exact_number(v_depth, 1u));
  gl_FragDepth = uintBitsToFloat(code);
  id = v_triangle;
}
)";
}

std::string value_vertex_source() {
  return R"(#version 400 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }
)";
}

}  // namespace etalon::gpu
