// Stored bits as exact numbers m · 2^e, and the small facts of the contract that need no arithmetic at all.
#pragma once

#include <bit>
#include <cstdint>

#include "core/base/error.h"
#include "core/draw/draw_list.h"

namespace etalon::validation::reference {

/// The number m · 2^e.
struct Binary {
  std::int64_t m = 0;
  int e = 0;
};

/// A finite float32: 1 sign bit, 8 exponent bits (0: subnormal), 23 bits of mantissa.
[[nodiscard]] inline Binary binary_of_float32(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const std::int64_t fraction = bits & 0x7FFFFF;
  const int exponent = static_cast<int>(bits >> 23 & 0xFF);
  ETALON_CHECK(exponent != 255, "the judge was given a number that is not finite");
  const std::int64_t magnitude = exponent == 0 ? fraction : fraction + 0x800000;
  return {(bits >> 31) != 0 ? -magnitude : magnitude, exponent == 0 ? -149 : exponent - 150};
}

/// A finite half: 1 sign bit, 5 exponent bits (0: subnormal), 10 bits of mantissa.
[[nodiscard]] inline Binary binary_of_half(std::uint16_t bits) {
  const std::int64_t fraction = bits & 0x3FF;
  const int exponent = bits >> 10 & 0x1F;
  ETALON_CHECK(exponent != 31, "the judge was given a number that is not finite");
  const std::int64_t magnitude = exponent == 0 ? fraction : fraction + 0x400;
  return {(bits >> 15) != 0 ? -magnitude : magnitude, exponent == 0 ? -24 : exponent - 25};
}

/// "An attribute, a depth, or a texel that is filtered, with |a| < 2^-40 enters as +0, and −0 enters as +0."
[[nodiscard]] inline float as_input(float a) {
  const float magnitude = a < 0 ? -a : a;
  return magnitude < 0x1p-40f ? 0.0f : a;
}

/// FillRule, as its comments in core/draw/state.h say it; dx, dy along an edge of a counter-clockwise triangle.
[[nodiscard]] inline bool owns_edge(FillRule rule, std::int64_t dx, std::int64_t dy) {
  switch (rule) {
    case FillRule::left_ymin: return dy < 0 || (dy == 0 && dx > 0);
    case FillRule::left_ymax: return dy < 0 || (dy == 0 && dx < 0);
    case FillRule::right_ymin: return dy > 0 || (dy == 0 && dx > 0);
    case FillRule::right_ymax: return dy > 0 || (dy == 0 && dx < 0);
  }
  return false;
}

/// "The draws cover the triangles in order without gap or overlap."
[[nodiscard]] inline const Draw& draw_holding(const DrawList& list, std::uint32_t t) {
  for (const Draw& draw : list.draws)
    if (t >= draw.first_triangle && t - draw.first_triangle < draw.triangle_count) return draw;
  throw_check_failed(__FILE__, __LINE__, "a draw holds the triangle", "the list was not validated");
}

/// The image of the first lookup, its sampler, or none for vertex colours: "of the first lookup (of uv in the map, for indexed)".
struct FirstLookup {
  const Image* image = nullptr;
  Sampler sampler;
};

[[nodiscard]] inline FirstLookup first_lookup(const DrawList& list, const Draw& draw) {
  switch (draw.shading) {
    case Shading::vertex_color: return {};
    case Shading::texture: return {list.images[draw.texture].get(), draw.sampler};
    case Shading::indexed: return {list.images[draw.indexing_map].get(), draw.map_sampler};
  }
  return {};
}

}  // namespace etalon::validation::reference
