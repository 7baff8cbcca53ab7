// Every freedom an API leaves to its implementation, as an explicit value; never a constant in a loop.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/image/pixel_format.h"

namespace etalon {

/// How a position is brought to the sub-texel grid (by core/draw, once, before either renderer sees it).
enum class SnapRounding : std::uint8_t { nearest_even, half_up, half_away, toward_zero, floor };

/// Who owns a sample that lies exactly on an edge of a counter-clockwise triangle (dx, dy along the edge, y up with the rows).
enum class FillRule : std::uint8_t {
  left_ymin,   ///< dy < 0, or dy = 0 and dx > 0: "top-left" when row 0 is drawn on top
  left_ymax,   ///< dy < 0, or dy = 0 and dx < 0
  right_ymin,  ///< dy > 0, or dy = 0 and dx > 0
  right_ymax,  ///< dy > 0, or dy = 0 and dx < 0
};

/// Rounding of values stored as half; some OpenGL drivers truncate.
enum class HalfRounding : std::uint8_t { nearest_even, toward_zero };

enum class CullMode : std::uint8_t { none, clockwise, counter_clockwise };  ///< which triangles are dropped

struct RasterState {
  int subtexel_bits = 8;  ///< 1..16: raster positions are multiples of 2^-subtexel_bits texel
  SnapRounding snap = SnapRounding::nearest_even;
  FillRule fill_rule = FillRule::left_ymin;
  HalfRounding half_rounding = HalfRounding::nearest_even;
  CullMode cull = CullMode::none;
  bool depth_test = true;  ///< nearer wins, equal: the earlier primitive; off: the later primitive wins
  friend bool operator==(const RasterState&, const RasterState&) = default;
};

enum class Filter : std::uint8_t { nearest, linear };
enum class Wrap : std::uint8_t { clamp, repeat, mirrored_repeat };

struct Sampler {
  Filter filter = Filter::nearest;
  Wrap wrap_u = Wrap::clamp;
  Wrap wrap_v = Wrap::clamp;
  friend bool operator==(const Sampler&, const Sampler&) = default;
};

/// What a target receives for the visible triangle of each texel (docs/contract.md#targets).
enum class TargetContent : std::uint8_t {
  color,         ///< the draw's shading, in any format but uint32
  triangle_id,   ///< index of the triangle in the draw list (R uint32; kNoTriangle where none)
  barycentrics,  ///< perspective-correct weights of vertices 0, 1, 2 (RGB; any format but uint32)
  coordinate,    ///< interpolated uv (RG; any format but uint32)
  depth,         ///< window depth (R float32)
  margins,       ///< RGBA float32: distance to the nearest edge in sub-texels; of u·width and of v·height to the nearest texel border, in
  ///< texels (of (u·width − ½), … for linear); depth gap to what would be drawn without the winner (+inf where there is nothing)
  bound_terms,  ///< RG float32: max(|∂(u·w)/∂x| + |∂(u·w)/∂y|, the same of v·h) in texels per texel; |∂z/∂x| + |∂z/∂y|
};

inline constexpr std::uint32_t kNoTriangle = 0xFFFFFFFFu;

struct TargetSpec {
  TargetContent content = TargetContent::color;
  PixelFormat format = kRgba8;
  std::array<float, 4> clear{0, 0, 0, 0};  ///< of color, barycentrics, coordinate; the others have fixed clears (kNoTriangle, depth 1, 0)
  friend bool operator==(const TargetSpec&, const TargetSpec&) = default;
};

/// What is drawn into: a frame of width × height texels, 1..16384 each.
struct Frame {
  int width = 1024;
  int height = 1024;
  int guard = 2048;  ///< texels around the frame in which vertices may lie; frame + 2·guard bounds all positions
  RasterState state;
  std::vector<TargetSpec> targets;
};

[[nodiscard]] std::string to_string(SnapRounding value);
[[nodiscard]] std::string to_string(FillRule value);
[[nodiscard]] std::string to_string(HalfRounding value);
[[nodiscard]] std::string to_string(Filter value);
[[nodiscard]] std::string to_string(Wrap value);
[[nodiscard]] std::string to_string(TargetContent value);

}  // namespace etalon
