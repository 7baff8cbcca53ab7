// The shaders of the exact mode, written for what a frame asks (docs/exact-shader.md). GLSL 4.00: doubles and integers, no extension.
//   visibility  one draw over all triangles: id and exact depth of what each texel shows
//   value       one triangle over the frame: the stored bits of one target, for the triangles of one group; by doubles, which flag the
//               texels that they cannot decide
//   exact value the same for a list of texels, by integers alone
#pragma once

#include <string>

#include "core/draw/draw_list.h"

namespace etalon::gpu {

/// Texture units of the samplers.
inline constexpr int kVerticesUnit = 0;   ///< three texels RGBA uint32 a vertex: x, y, z, w; u, v, red, green; blue, alpha, 0, 0
inline constexpr int kTrianglesUnit = 1;  ///< one texel RGBA uint32 a triangle: its vertices and its group
inline constexpr int kIdsUnit = 2;        ///< what the visibility pass wrote
inline constexpr int kExactImageUnit = 3;
inline constexpr int kExactMapUnit = 4;
inline constexpr int kTablesUnit = 5;  ///< 256 × 2 uint32: row 0 sRGB decoded, row 1 the thresholds T_1 .. T_255, as float32 bits
inline constexpr int kListUnit = 6;    ///< texels for the exact pass: x | y << 16, or kNoTexel

/// Texels in a row of the record textures, and of the list.
inline constexpr int kRecordWidth = 8192;
inline constexpr int kListWidth = 1024;
inline constexpr std::uint32_t kNoTexel = 0xFFFFFFFFu;

/// Edge values are exact in double up to here: 14 bits of texels and 8 of sub-texels a side make |E| < 2^45.
inline constexpr int kExactSubtexelBits = 8;

/// What a value shader is written for. Sub-texel bits, rounding of halves and wraps are uniforms.
struct ValueShader {
  TargetContent content = TargetContent::color;
  PixelFormat target{};
  Shading shading = Shading::vertex_color;  ///< of colour targets, as all that follows
  PixelFormat image{};
  Filter filter = Filter::nearest;
  PixelFormat map{};
  Filter map_filter = Filter::nearest;
};

/// `integers_only`: depths by integers too, whatever doubles say, and every texel flagged: a second opinion for tests.
[[nodiscard]] std::string visibility_vertex_source();
[[nodiscard]] std::string visibility_fragment_source(bool integers_only);
[[nodiscard]] std::string value_vertex_source();
/// Outputs: 0 the codes, 1 the group + 1 where doubles did not decide, else 0.
[[nodiscard]] std::string value_fragment_source(const ValueShader& shader, bool integers_only);
/// Output: the codes of the list's texel at the fragment's place.
[[nodiscard]] std::string exact_value_fragment_source(const ValueShader& shader);

}  // namespace etalon::gpu
