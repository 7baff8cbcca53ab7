#include "gpu/exact_shaders.h"

#include <bit>

#include <fmt/core.h>

#include "core/base/error.h"
#include "gpu/exact_glsl.h"

namespace etalon::gpu {

namespace {

// Widths for the whole of the contract's input at 8 sub-texel bits (docs/exact-shader.md#widths): depth 110 bits, other numbers 294.
constexpr int kDepthLimbs = 4;
constexpr int kScalarLimbs = 10;

std::string head(int limbs) {
  const int half_limbs = static_cast<int>(std::bit_floor(static_cast<unsigned>(limbs - 1)));
  return fmt::format("#version 400 core\n#define LIMBS {}\n#define HALF_LIMBS {}\n#define RECORD_WIDTH {}u\nuniform int subtexel_bits;\n",
                     limbs, half_limbs, kRecordWidth);
}

std::string join(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) text += part;
  return text;
}

std::string storage(ChannelType type) {
  switch (type) {
    case ChannelType::unorm8: return "#define SCALE 255u\n" + join({kGlslUnorm, kGlslStoreUnorm});
    case ChannelType::srgb8: return "#define SCALE 255u\n" + join({kGlslUnorm, kGlslStoreSrgb});
    case ChannelType::unorm16: return "#define SCALE 65535u\n" + join({kGlslUnorm, kGlslStoreUnorm});
    case ChannelType::half: return std::string(kGlslStoreHalf);
    case ChannelType::float32: return std::string(kGlslStoreFloat32);
    case ChannelType::uint32: break;
  }
  ETALON_CHECK(false, to_string(type));
  return {};
}

/// double NAME(uint raw, bool alpha): the number a channel of an image means, exact or (unorm) within 2^-53.
std::string texel_number(const std::string& name, ChannelType type) {
  std::string value;
  switch (type) {
    case ChannelType::unorm8: value = "double(raw) / 255.0lf"; break;
    case ChannelType::unorm16: value = "double(raw) / 65535.0lf"; break;
    case ChannelType::half: value = "half_number(raw)"; break;
    case ChannelType::float32: value = "float_number(raw)"; break;
    case ChannelType::srgb8:
      value = "alpha ? double(raw) / 255.0lf : double(uintBitsToFloat(texelFetch(tables, ivec2(int(raw), 0), 0).r))";
      break;
    case ChannelType::uint32: ETALON_CHECK(false, to_string(type));
  }
  return fmt::format("double {}(uint raw, bool alpha) {{\n  precise double value = {};\n  return value;\n}}\n", name, value);
}

/// int second_index(uint raw, int size): floor of a stored coordinate times a size, exact: by integers, or a product of 24 and 15 bits.
std::string second_index(ChannelType type) {
  if (type == ChannelType::unorm8 || type == ChannelType::unorm16) {
    return fmt::format("int second_index(uint raw, int size) {{ return int(raw * uint(size) / {}u); }}\n",
                       type == ChannelType::unorm8 ? 255 : 65535);
  }
  return "int second_index(uint raw, int size) { return floor_of(map_number(raw, false) * double(size)); }\n";
}

/// uvec4 NAME_texel(ivec2 index): the raw channels of the texel that an index names.
std::string fetch(const std::string& name) {
  return fmt::format(
      "uvec4 {0}_texel(ivec2 i) {{\n  ivec2 size = textureSize({0}, 0);\n"
      "  return texelFetch({0}, ivec2(wrapped(i.x, size.x, {0}_wrap.x), wrapped(i.y, size.y, {0}_wrap.y)), 0);\n}}\n",
      name);
}

/// uint texel_code(uint raw, bool alpha): a channel of the image as the target stores it. Same type: the same bits, but for −0.
std::string texel_code(ChannelType image, ChannelType target) {
  std::string code = "code_of(image_number(raw, alpha), alpha)";
  if (image == target) {
    code = image == ChannelType::half      ? "raw == 0x8000u ? 0u : raw"
           : image == ChannelType::float32 ? "raw == 0x80000000u ? 0u : raw"
                                           : "raw";
  }
  return fmt::format("uint texel_code(uint raw, bool alpha) {{ return {}; }}\n", code);
}

enum class Stage : std::uint8_t { doubles, integers };

/// The statements that set codes[c] for c < channels from numbers that are interpolated and stored.
std::string store_numbers(Stage stage, const std::string& bits_of_channel, const std::string& enclosing, int channels) {
  // Unrolled where all is short; one copy of the long division.
  if (stage == Stage::integers) {
    return fmt::format(R"(  for (int c = 0; c < channels; ++c) {{
    bool alpha = c == 3;
    codes[c] = code_of(exact_number({}, store_scale(alpha)), alpha);
  }}
)",
                       bits_of_channel);
  }
  return fmt::format(R"(  for (int c = 0; c < {}; ++c) {{
    uvec3 bits = {};
    double lo, hi;
    {};
    uint code;
    flagged = !try_store(lo, hi, c == 3, code) || flagged;
    codes[c] = code;
  }}
)",
                     channels, bits_of_channel, enclosing);
}

/// ivec2 INDEX = the texel that uv names in the image.
std::string find_index(Stage stage, const std::string& image) {
  if (stage == Stage::integers) {
    return fmt::format(
        "  ivec2 {0}_index;\n  for (int axis = 0; axis < 2; ++axis) {0}_index[axis] = exact_index(axis == 0 ? u_bits : v_bits, "
        "textureSize({0}, 0)[axis]);\n",
        image);
  }
  return fmt::format(
      "  ivec2 {0}_size = textureSize({0}, 0), {0}_index;\n"
      "  flagged = !try_index(u_bits, {0}_size.x, {0}_index.x) || flagged;\n"
      "  flagged = !try_index(v_bits, {0}_size.y, {0}_index.y) || flagged;\n",
      image);
}

std::string store_texel(const ValueShader& shader, const std::string& index) {
  std::string text = fmt::format("  uvec4 raw = image_texel({});\n", index);
  for (int c = 0; c < shader.target.channels; ++c) {
    text += c < shader.image.channels ? fmt::format("  codes[{0}] = texel_code(raw[{0}], {1});\n", c, c == 3)
                                      : fmt::format("  codes[{0}] = code_of({1}, {2});\n", c, c == 3 ? "1.0lf" : "0.0lf", c == 3);
  }
  return text;
}

constexpr std::string_view kUvBits = R"(
  uvec3 u_bits, v_bits;
  for (int i = 0; i < 3; ++i) {
    uvec4 words = vertex_words(triangle[i], 1u);
    u_bits[i] = words.x;
    v_bits[i] = words.y;
  }
)";
constexpr std::string_view kColorBits = R"(
  uvec3 color_bits[4];
  for (int i = 0; i < 3; ++i) {
    uvec4 first = vertex_words(triangle[i], 1u), second = vertex_words(triangle[i], 2u);
    color_bits[0][i] = first.z;
    color_bits[1][i] = first.w;
    color_bits[2][i] = second.x;
    color_bits[3][i] = second.y;
  }
)";

/// The functions and the statements of main() that give the codes of a target.
struct Body {
  std::string functions;
  std::string statements;
};

Body texture_body(const ValueShader& shader, Stage stage) {
  Body body;
  body.functions = std::string(kGlslTexelChoice) + texel_number("image_number", shader.image.type) + fetch("image") +
                   texel_code(shader.image.type, shader.target.type);
  body.statements = kUvBits;
  if (shader.shading == Shading::texture) {
    body.statements += find_index(stage, "image") + store_texel(shader, "image_index");
    return body;
  }
  body.functions += texel_number("map_number", shader.map.type) + fetch("indexing_map") + second_index(shader.map.type);
  body.statements += find_index(stage, "indexing_map");
  body.statements += "  uvec4 at = indexing_map_texel(indexing_map_index);\n  ivec2 size = textureSize(image, 0);\n";
  body.statements += store_texel(shader, "ivec2(second_index(at.x, size.x), second_index(at.y, size.y))");
  return body;
}

Body body_of(const ValueShader& shader, Stage stage) {
  const int channels = shader.target.channels;
  switch (shader.content) {
    case TargetContent::barycentrics:
      return {"", store_numbers(stage, "(uvec3(c == 0, c == 1, c == 2) * 0x3F800000u)", "enclose_barycentric(c, lo, hi)", channels)};
    case TargetContent::coordinate:
      return {"", std::string(kUvBits) + store_numbers(stage, "(c == 0 ? u_bits : v_bits)", "enclose(bits, lo, hi)", channels)};
    case TargetContent::color:
      if (shader.shading != Shading::vertex_color) return texture_body(shader, stage);
      return {"", std::string(kColorBits) + store_numbers(stage, "color_bits[c]", "enclose(bits, lo, hi)", channels)};
    default: break;
  }
  ETALON_CHECK(false, to_string(shader.content));
  return {};
}

constexpr std::string_view kUniforms = R"(
uniform usampler2D vertices;
uniform usampler2D triangles;
uniform usampler2D ids;
uniform usampler2D image;
uniform usampler2D indexing_map;
uniform usampler2D tables;
uniform usampler2D list;
uniform uint group;
uniform int channels;
uniform ivec2 image_wrap;
uniform ivec2 indexing_map_wrap;
uniform bool toward_zero;
layout(location = 0) out uvec4 stored;
)";

std::string value_functions(const ValueShader& shader, const Body& body) {
  return join({kUniforms, kGlslIntegers, kGlslNumbers, kGlslRecords, kGlslBits}) + storage(shader.target.type) + body.functions;
}

}  // namespace

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
  return head(kDepthLimbs) + join({kGlslIntegers, kGlslNumbers, kGlslBits, kGlslStoreFloat32}) + R"(
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
  bool decided = try_store(lo, hi, false, code);
  if ()" +
         std::string(integers_only ? "true" : "!decided") +
         R"() code = code_of(exact_number(v_depth, 1u), false);
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

std::string value_fragment_source(const ValueShader& shader, bool integers_only) {
  const Body body = body_of(shader, Stage::doubles);
  const std::string others = shader.content == TargetContent::color ? "  if (triangle.w != group) discard;\n" : "";
  return head(kScalarLimbs) + value_functions(shader, body) + R"(
layout(location = 1) out uint undecided;
void main() {
  texel = ivec2(gl_FragCoord.xy);
  uint id = texelFetch(ids, texel, 0).r;
  if (id == 0xFFFFFFFFu) discard;
  uvec4 triangle = texelFetch(triangles, record(id), 0);
)" + others +
         R"(
  set_triangle(triangle);
  uvec4 codes = uvec4(0u);
  bool flagged = )" +
         (integers_only ? "true" : "false") + ";\n" + body.statements + R"(
  stored = codes;
  undecided = flagged ? group + 1u : 0u;
}
)";
}

std::string exact_value_fragment_source(const ValueShader& shader) {
  const Body body = body_of(shader, Stage::integers);
  return head(kScalarLimbs) + value_functions(shader, body) + R"(
void main() {
  uint place = texelFetch(list, ivec2(gl_FragCoord.xy), 0).r;
  if (place == 0xFFFFFFFFu) discard;
  texel = ivec2(place & 0xFFFFu, place >> 16);
  uvec4 triangle = texelFetch(triangles, record(texelFetch(ids, texel, 0).r), 0);
  set_triangle(triangle);
  uvec4 codes = uvec4(0u);
)" + body.statements +
         R"(
  stored = codes;
}
)";
}

}  // namespace etalon::gpu
