// The text of the value shaders. Both stages say the same of a texel, one by doubles with flags, one by integers.
#include <algorithm>
#include <cstdint>

#include <fmt/core.h>

#include "core/base/error.h"
#include "gpu/exact_glsl.h"
#include "gpu/exact_shaders.h"

namespace etalon::gpu {

namespace {

enum class Stage : std::uint8_t { doubles, integers };

// Widths for the whole of the contract's input at 8 sub-texel bits (docs/exact-shader.md#widths).
constexpr int kScalarLimbs = 10;
constexpr int kLinearLimbs = 17;
constexpr int kLinearFloatLimbs = 20;

int limbs_of(const ValueShader& shader) {
  if (shader.content != TargetContent::color || shader.shading == Shading::vertex_color) return kScalarLimbs;
  const bool indexed = shader.shading == Shading::indexed;
  const bool linear = shader.filter == Filter::linear, map_linear = indexed && shader.map_filter == Filter::linear;
  if ((linear && shader.image.type == ChannelType::float32) || (map_linear && shader.map.type == ChannelType::float32))
    return kLinearFloatLimbs;
  return linear || map_linear ? kLinearLimbs : kScalarLimbs;
}

std::string storage(ChannelType type) {
  switch (type) {
    case ChannelType::unorm8: return "#define SCALE 255u\n" + joined({kGlslUnorm, kGlslStoreUnorm});
    case ChannelType::srgb8: return "#define SCALE 255u\n" + joined({kGlslUnorm, kGlslStoreSrgb});
    case ChannelType::unorm16: return "#define SCALE 65535u\n" + joined({kGlslUnorm, kGlslStoreUnorm});
    case ChannelType::half: return std::string(kGlslStoreHalf);
    case ChannelType::float32: return std::string(kGlslStoreFloat32);
    case ChannelType::uint32: break;
  }
  ETALON_CHECK(false, to_string(type));
  return {};
}

/// What a channel of type `type` means, for raw bits:
///   double NAME_number(uint raw, bool alpha)    the number, exact or (unorm) within 2^-53
///   Parts NAME_parts(uint raw, bool alpha), uint NAME_denominator(bool alpha)    the number as a fraction
///   uint NAME_filtered(uint raw)    the raw bits that stand for it where it is filtered
std::string number_functions(const std::string& name, ChannelType type) {
  std::string number, parts, denominator = "1u", filtered = "raw";
  switch (type) {
    case ChannelType::unorm8:
    case ChannelType::unorm16:
      denominator = type == ChannelType::unorm8 ? "255u" : "65535u";
      number = fmt::format("double(raw) / double({})", denominator);
      parts = "Parts(raw, 0, false)";
      break;
    case ChannelType::srgb8:
      denominator = "alpha ? 255u : 1u";
      number = "alpha ? double(raw) / 255.0lf : double(uintBitsToFloat(texelFetch(tables, ivec2(int(raw), 0), 0).r))";
      parts = "alpha ? Parts(raw, 0, false) : float_parts(texelFetch(tables, ivec2(int(raw), 0), 0).r)";
      break;
    case ChannelType::half:
      number = "half_number(raw)";
      parts = "half_parts(raw)";
      break;
    case ChannelType::float32:
      number = "float_number(raw)";
      parts = "float_parts(raw)";
      filtered = "canonical_bits(raw)";
      break;
    case ChannelType::uint32: ETALON_CHECK(false, to_string(type));
  }
  return fmt::format(
      "double {0}_number(uint raw, bool alpha) {{\n  precise double value = {1};\n  return value;\n}}\n"
      "Parts {0}_parts(uint raw, bool alpha) {{ return {2}; }}\nuint {0}_denominator(bool alpha) {{ return {3}; }}\n"
      "uint {0}_filtered(uint raw) {{ return {4}; }}\n",
      name, number, parts, denominator, filtered);
}

/// uvec4 NAME_texel(ivec2 index): the raw channels of the texel that an index names.
std::string fetch(const std::string& name) {
  return fmt::format(
      "uvec4 {0}_texel(ivec2 i) {{\n  ivec2 size = textureSize({0}, 0);\n"
      "  return texelFetch({0}, ivec2(wrapped(i.x, size.x, {0}_wrap.x), wrapped(i.y, size.y, {0}_wrap.y)), 0);\n}}\n",
      name);
}

/// Places along an axis of a stored coordinate: second_index(), exact by integers or by a product of 24 and 15 bits; second_axis().
std::string second_functions(Stage stage, ChannelType type, Filter filter) {
  const bool unorm = type == ChannelType::unorm8 || type == ChannelType::unorm16;
  if (filter == Filter::nearest) {
    return unorm ? "int second_index(uint raw, int size) { return int(raw * uint(size) / at_denominator(false)); }\n"
                 : "int second_index(uint raw, int size) { return floor_of(at_number(raw, false) * double(size)); }\n";
  }
  if (stage == Stage::integers) {
    return "ExactAxis second_axis(uint raw, int size) { return exact_stored_axis(at_parts(raw, false), at_denominator(false), size); }\n";
  }
  return unorm ? "Axis second_axis(uint raw, int size) { return stored_axis(raw, at_denominator(false), size); }\n"
               : "Axis second_axis(uint raw, int size) { return stored_axis(at_number(raw, false), size); }\n";
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

/// Sets codes[c] for c < channels from numbers that are interpolated and stored.
std::string store_numbers(Stage stage, const std::string& bits_of_channel, const std::string& enclosing, int channels) {
  // One copy of the long division; doubles are short enough to be unrolled.
  if (stage == Stage::integers) {
    return fmt::format("  for (int c = 0; c < channels; ++c) codes[c] = code_of(exact_number({}, store_scale(c == 3)), c == 3);\n",
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

/// NAME_raw: the texel that uv names under nearest; under linear the four, and the axes NAME_u and NAME_v.
std::string look_up(Stage stage, const std::string& name, Filter filter) {
  const bool integers = stage == Stage::integers;
  if (filter == Filter::nearest) {
    std::string place = "  ivec2 {0}_size = textureSize({0}, 0), {0}_place;\n";
    place += integers ? "  for (int a = 0; a < 2; ++a) {0}_place[a] = exact_index(a == 0 ? u_bits : v_bits, {0}_size[a]);\n"
                      : "  flagged = !try_index(u_bits, {0}_size.x, {0}_place.x) || flagged;\n"
                        "  flagged = !try_index(v_bits, {0}_size.y, {0}_place.y) || flagged;\n";
    return fmt::format(fmt::runtime(place + "  uvec4 {0}_raw = {0}_texel({0}_place);\n"), name);
  }
  return fmt::format(fmt::runtime(integers ? "  ExactAxis {0}_u = exact_axis(u_bits, textureSize({0}, 0).x);\n"
                                             "  ExactAxis {0}_v = exact_axis(v_bits, textureSize({0}, 0).y);\n"
                                           : "  Axis {0}_u, {0}_v;\n"
                                             "  flagged = !try_axis(u_bits, textureSize({0}, 0).x, {0}_u) || flagged;\n"
                                             "  flagged = !try_axis(v_bits, textureSize({0}, 0).y, {0}_v) || flagged;\n"),
                     name);
}

std::string four_texels(const std::string& name) {
  return fmt::format(
      "  uvec4 {0}_raw[4];\n"
      "  for (int k = 0; k < 4; ++k) {0}_raw[k] = {0}_texel(ivec2({0}_u.index + (k & 1), {0}_v.index + (k >> 1)));\n",
      name);
}

/// Channel c of a linear lookup: `lo` and `hi`, or `exact` times a scale; in a block of its own.
std::string linear_value(Stage stage, const std::string& name, const std::string& scale) {
  return fmt::format(
      fmt::runtime(stage == Stage::integers ? "    Parts t[4];\n"
                                              "    for (int k = 0; k < 4; ++k) t[k] = {0}_parts({0}_filtered({0}_raw[k][c]), c == 3);\n"
                                              "    Leading exact = exact_linear({0}_u, {0}_v, t, {0}_denominator(c == 3), {1});\n"
                                            : "    dvec4 t;\n"
                                              "    for (int k = 0; k < 4; ++k) t[k] = {0}_number({0}_filtered({0}_raw[k][c]), c == 3);\n"
                                              "    double lo, hi;\n"
                                              "    enclose_linear({0}_u, {0}_v, t, lo, hi);\n"),
      name, scale);
}

/// Sets codes[c] from image_raw.
std::string store_image(const ValueShader& shader, Stage stage) {
  std::string text;
  const int present = std::min(shader.target.channels, shader.image.channels);
  if (shader.filter == Filter::nearest) {
    for (int c = 0; c < present; ++c) text += fmt::format("  codes[{0}] = texel_code(image_raw[{0}], {1});\n", c, c == 3);
  } else {
    text += fmt::format("  for (int c = 0; c < {}; ++c) {{\n", present) + linear_value(stage, "image", "store_scale(c == 3)");
    text += stage == Stage::integers
                ? "    codes[c] = code_of(exact, c == 3);\n  }\n"
                : "    uint code;\n    flagged = !try_store(lo, hi, c == 3, code) || flagged;\n    codes[c] = code;\n  }\n";
  }
  for (int c = present; c < shader.target.channels; ++c)
    text += fmt::format("  codes[{}] = code_of({}, {});\n", c, c == 3 ? "1.0lf" : "0.0lf", c == 3);
  return text;
}

/// at: the stored coordinate that the map gives, as raw bits of the map's type or, filtered linearly, of a float32.
std::string map_value(Stage stage, Filter filter) {
  std::string text = look_up(stage, "indexing_map", filter);
  if (filter == Filter::nearest) return text + "  uvec2 at = indexing_map_raw.xy;\n";
  text += four_texels("indexing_map") + "  uvec2 at;\n  for (int c = 0; c < 2; ++c) {\n" + linear_value(stage, "indexing_map", "1u");
  text += stage == Stage::integers
              ? "    at[c] = canonical_bits(float32_code(exact));\n  }\n"
              : "    uint code;\n    flagged = !try_float32(lo, hi, code) || flagged;\n    at[c] = canonical_bits(code);\n  }\n";
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
  body.functions = joined({kGlslTexelChoice, stage == Stage::integers ? kGlslExactLinear : kGlslLinear});
  body.functions += number_functions("image", shader.image.type) + fetch("image") + texel_code(shader.image.type, shader.target.type);
  body.statements = kUvBits;
  const bool linear = shader.filter == Filter::linear;
  if (shader.shading == Shading::texture) {
    body.statements += look_up(stage, "image", shader.filter);
  } else {
    const ChannelType at = shader.map_filter == Filter::linear ? ChannelType::float32 : shader.map.type;
    body.functions += number_functions("indexing_map", shader.map.type) + fetch("indexing_map") + number_functions("at", at) +
                      second_functions(stage, at, shader.filter);
    body.statements += map_value(stage, shader.map_filter) + "  ivec2 size = textureSize(image, 0);\n";
    const std::string axis = stage == Stage::integers ? "ExactAxis" : "Axis";
    body.statements += linear ? "  " + axis + " image_u = second_axis(at.x, size.x), image_v = second_axis(at.y, size.y);\n"
                              : "  uvec4 image_raw = image_texel(ivec2(second_index(at.x, size.x), second_index(at.y, size.y)));\n";
  }
  if (linear) body.statements += four_texels("image");
  body.statements += store_image(shader, stage);
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

/// Everything before main().
std::string functions_of(const ValueShader& shader, const Body& body) {
  return exact_shader_head(limbs_of(shader)) + joined({kUniforms, kGlslIntegers, kGlslNumbers, kGlslRecords, kGlslBits, kGlslFloat32}) +
         storage(shader.target.type) + body.functions;
}

}  // namespace

std::string value_fragment_source(const ValueShader& shader, bool integers_only) {
  const Body body = body_of(shader, Stage::doubles);
  const std::string others = shader.content == TargetContent::color ? "  if (triangle.w != group) discard;\n" : "";
  return functions_of(shader, body) + R"(
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
  return functions_of(shader, body) + R"(
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
